//! Environments as pictures.
