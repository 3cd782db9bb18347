//! DirectDraw surfaces.

/// How every file starts.
pub(in crate::imaging) const SIGNATURE: [u8; 4] = *b"DDS ";
