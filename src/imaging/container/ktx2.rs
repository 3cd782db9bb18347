//! KTX 2.0.

/// How every file starts.
pub(in crate::imaging) const SIGNATURE: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";
