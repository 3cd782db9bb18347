//! Direction to chart and back.
