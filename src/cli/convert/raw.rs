//! Frames of bare pixels in pipes.

use std::io::{self, Read, Write};

use super::error::ConvertError;
use super::options::RawFormat;
use crate::imaging::load::{MOST_RASTER_BYTES, MOST_SIDE};
use crate::imaging::{Raster, SampleKind, Samples};

/// Bytes that are turned into numbers at once: a whole number of samples, small enough for the second-level cache.
const BLOCK: usize = 1 << 16;

/// Format and size of every frame of a pipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RawFrames {
    pub format: RawFormat,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl RawFrames {
    /// The two words after `--raw`.
    ///
    /// # Errors
    /// When they name no format or no size that can be held.
    pub fn parse(words: &[String]) -> Result<Self, String> {
        let [format, size] = words else {
            return Err("--raw takes a format and a size, like rgb24 4096x2048".to_owned());
        };
        let format = RawFormat::from_id(format)?;
        let side = |text: &str| text.parse().ok().filter(|n| (1..=MOST_SIDE).contains(n));
        let frames = size
            .split_once(['x', 'X'])
            .and_then(|(width, height)| Some([side(width)?, side(height)?]))
            .map(|size| Self { format, size })
            .ok_or_else(|| {
                format!("`{size}` is no size of a frame: WIDTHxHEIGHT, 1 to {MOST_SIDE} each")
            })?;
        if frames.bytes() > MOST_RASTER_BYTES {
            return Err(format!(
                "a frame of {size} takes {} bytes, the limit is {MOST_RASTER_BYTES}; scale it down before",
                frames.bytes()
            ));
        }
        Ok(frames)
    }

    /// Bytes of a frame.
    pub fn bytes(&self) -> u64 {
        let (samples, _, channels) = self.format.kind();
        self.samples() / channels.count() as u64 * (samples.bytes() * channels.count()) as u64
    }

    fn samples(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * self.format.kind().2.count() as u64
    }

    /// A black frame.
    ///
    /// # Errors
    /// When there is no memory.
    pub fn black(&self) -> Result<Raster, ConvertError> {
        let (kind, transfer, channels) = self.format.kind();
        let count = self.samples();
        let samples = match kind {
            SampleKind::U8 => zeros(count).map(Samples::U8),
            SampleKind::U16 => zeros(count).map(Samples::U16),
            SampleKind::F32 => zeros(count).map(Samples::F32),
        };
        samples
            .and_then(|samples| Raster::new(self.size, channels, transfer, samples))
            .ok_or(ConvertError::OutOfMemory(self.bytes()))
    }
}

/// Zeros, or `None` where `vec!` would end the process.
fn zeros<T: Clone + Default>(count: u64) -> Option<Vec<T>> {
    let count = usize::try_from(count).ok()?;
    Vec::<T>::new().try_reserve_exact(count).ok()?;
    Some(vec![T::default(); count])
}

/// Fills a frame; false when the input ends before its first byte. `frame`, counted from 1, is for the message.
///
/// # Errors
/// When the input fails or ends within the frame.
pub(super) fn read(
    input: &mut impl Read,
    raster: &mut Raster,
    frame: u64,
) -> Result<bool, ConvertError> {
    let whole = raster.bytes();
    let outcome = match raster.samples_mut() {
        Samples::U8(samples) => read_full(input, samples),
        Samples::U16(samples) => read_numbers(input, samples, u16::from_le_bytes),
        Samples::F32(samples) => read_numbers(input, samples, f32::from_le_bytes),
    };
    match outcome.map_err(ConvertError::Read)? {
        0 => Ok(false),
        bytes if bytes as u64 == whole => Ok(true),
        bytes => Err(ConvertError::CutShort {
            frame,
            bytes,
            whole,
        }),
    }
}

/// Reads until the buffer is full or the input ends; how many bytes came.
fn read_full(input: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut done = 0;
    while done < buffer.len() {
        match input.read(&mut buffer[done..]) {
            Ok(0) => break,
            Ok(count) => done += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(done)
}

fn read_numbers<T, const N: usize>(
    input: &mut impl Read,
    samples: &mut [T],
    number: fn([u8; N]) -> T,
) -> io::Result<usize> {
    let mut block = vec![0; BLOCK];
    let mut done = 0;
    for samples in samples.chunks_mut(BLOCK / N) {
        let block = &mut block[..samples.len() * N];
        let came = read_full(input, block)?;
        done += came;
        for (sample, bytes) in samples.iter_mut().zip(block.as_chunks().0) {
            *sample = number(*bytes);
        }
        if came < block.len() {
            break;
        }
    }
    Ok(done)
}

/// Writes a frame.
///
/// # Errors
/// When the output fails.
pub(super) fn write(output: &mut impl Write, raster: &Raster) -> io::Result<()> {
    match raster.samples() {
        Samples::U8(samples) => output.write_all(samples),
        Samples::U16(samples) => write_numbers(output, samples, u16::to_le_bytes),
        Samples::F32(samples) => write_numbers(output, samples, f32::to_le_bytes),
    }?;
    output.flush()
}

fn write_numbers<T: Copy, const N: usize>(
    output: &mut impl Write,
    samples: &[T],
    bytes: fn(T) -> [u8; N],
) -> io::Result<()> {
    let mut block = vec![0; BLOCK];
    for samples in samples.chunks(BLOCK / N) {
        let block = &mut block[..samples.len() * N];
        for (sample, place) in samples.iter().zip(block.as_chunks_mut().0) {
            *place = bytes(*sample);
        }
        output.write_all(block)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(words: [&str; 2]) -> Result<RawFrames, String> {
        RawFrames::parse(&words.map(str::to_owned))
    }

    #[test]
    fn every_format_comes_back_and_a_cut_frame_is_told() {
        for (format, size) in [("rgb24", 3), ("rgb48le", 6), ("rgbf32le", 12)] {
            let frames = frames([format, "5x3"]).unwrap();
            assert_eq!(frames.bytes(), 15 * size);
            let bytes: Vec<u8> = (0..frames.bytes()).map(|i| (i % 61) as u8).collect();
            let mut raster = frames.black().unwrap();
            assert!(read(&mut &bytes[..], &mut raster, 1).unwrap());
            let mut back = Vec::new();
            write(&mut back, &raster).unwrap();
            assert_eq!(back, bytes, "{format}");
            assert!(!read(&mut &bytes[..0], &mut raster, 2).unwrap());
            let cut = read(&mut &bytes[1..], &mut raster, 3).unwrap_err();
            let ConvertError::CutShort { frame, bytes: came, whole } = cut else {
                panic!("{cut}");
            };
            assert_eq!((frame, came as u64 + 1, whole), (3, whole, bytes.len() as u64));
        }
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        for size in ["0x1", "1x0", "-1x2", "12", "x", "99999999999x1", "49152x49152", "70000x1"] {
            let line = frames(["rgb24", size]).unwrap_err();
            assert!(!line.contains('\n') && line.contains(size), "{line}");
        }
        assert!(frames(["rgb25", "2x2"]).unwrap_err().contains("rgb48le"));
    }
}
