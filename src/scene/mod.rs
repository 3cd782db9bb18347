//! Camera, objects and what the pointer hits.
