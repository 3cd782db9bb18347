//! What `sixfold convert` is asked for, word by word. Whether the words fit together is the [`super::task`]'s concern.

use std::path::PathBuf;

use clap::ValueEnum;

use crate::imaging::resample::{Filter, FilteredIn, Isa, MOST_SIDE};
use crate::imaging::{Channels, SampleKind, Siting, Stored, Transfer};
use crate::mapping::MappingId;

/// Options of `sixfold convert`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(in crate::cli) struct ConvertOptions {
    /// The map: a file, six files (`%f` stands for the face's name), numbered files (`%04d`), the name of a built-in
    /// environment (`labelled-faces`), or `-` with --raw
    #[arg(value_name = "IN")]
    pub input: PathBuf,
    /// The file to write: .hdr, .exr, .png, .jpg, .ktx2 or .dds; with `%f` one for each face, with `%04d` one for each
    /// frame; `-` with --raw
    #[arg(
        value_name = "OUT",
        required_unless_present = "inspect",
        conflicts_with = "inspect"
    )]
    pub output: Option<PathBuf>,
    /// Only say what IN seems to be, with the score of each proposal, and convert nothing
    #[arg(long)]
    pub inspect: bool,

    /// The mapping of IN (`sixfold maps` lists them); guessed where shape and metadata leave no doubt
    #[arg(long, value_name = "MAP", help_heading = "What comes in")]
    pub from: Option<MappingId>,
    /// How the charts of IN lie in its picture
    #[arg(long, value_name = "LAYOUT", help_heading = "What comes in")]
    pub from_layout: Option<String>,
    /// The program whose axes IN has (openexr, threejs, unreal, ...)
    #[arg(long, value_name = "NAME", help_heading = "What comes in")]
    pub from_frame: Option<String>,
    /// What the pictures +x,-x,+y,-y,+z,-z of IN really show, as in `+x,-x,+y:180,-y,-z:mirrored,+z`; --inspect finds it
    #[arg(
        long,
        value_name = "FACES",
        allow_hyphen_values = true,
        help_heading = "What comes in"
    )]
    pub arrange: Option<String>,
    /// IN is a mirror image: left and right are exchanged all around
    #[arg(long, help_heading = "What comes in")]
    pub from_mirrored: bool,
    /// Where the samples of IN sit
    #[arg(long, value_enum, value_name = "WHERE", help_heading = "What comes in")]
    pub from_samples: Option<SamplesAt>,
    /// How the numbers of IN become light; left out: floats are light, codes of 8 and 16 bits are sRGB's unless the file
    /// says otherwise
    #[arg(
        long,
        value_enum,
        value_name = "TRANSFER",
        help_heading = "What comes in"
    )]
    pub from_transfer: Option<Numbers>,
    /// Read frames of WxH pixels from standard input until it ends and write each converted frame to standard output, in
    /// the same format: rgb24, rgb48le or rgbf32le
    #[arg(long, num_args = 2, value_names = ["FORMAT", "WxH"], help_heading = "What comes in")]
    pub raw: Option<Vec<String>>,

    /// The mapping of OUT; the same as IN's when left out
    #[arg(long, value_name = "MAP", help_heading = "What comes out")]
    pub to: Option<MappingId>,
    /// Rows of a chart; its width follows. Left out: as many texels around the horizon as IN has
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SIDE)),
        help_heading = "What comes out"
    )]
    pub size: Option<u32>,
    /// How the charts lie: cross, vertical-cross, vertical-cross-upright, row, column, 3x2, 3x2-turned, staircase, or faces, a
    /// file each
    #[arg(long, value_name = "LAYOUT", help_heading = "What comes out")]
    pub layout: Option<String>,
    /// Convert only these charts, by their names: +x,-z
    #[arg(
        long,
        value_name = "CHARTS",
        value_delimiter = ',',
        allow_hyphen_values = true,
        help_heading = "What comes out"
    )]
    pub faces: Vec<String>,
    /// Names for `%f`, one for each chart of the mapping, in its order; left out: px,nx,py,ny,pz,nz
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        help_heading = "What comes out"
    )]
    pub face_names: Vec<String>,
    /// The program whose axes OUT has
    #[arg(long, value_name = "NAME", help_heading = "What comes out")]
    pub to_frame: Option<String>,
    /// Turn the viewer: YAW to the right, then PITCH up, then ROLL clockwise, in degrees. The middle of OUT shows what was
    /// YAW degrees to the right of IN's, so a positive yaw moves the picture to the left
    #[arg(
        long,
        value_name = "YAW,PITCH,ROLL",
        allow_hyphen_values = true,
        value_parser = angles,
        help_heading = "What comes out"
    )]
    pub rotate: Option<[f64; 3]>,
    /// Where the samples of OUT sit
    #[arg(
        long,
        value_enum,
        value_name = "WHERE",
        help_heading = "What comes out"
    )]
    pub samples: Option<SamplesAt>,

    /// How values between texels are found; left out: `area` where OUT is coarser, else `bicubic`
    #[arg(long, value_enum, help_heading = "Light")]
    pub filter: Option<FilterName>,
    /// Ask the filter at N x N places in each texel
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=64),
        help_heading = "Light"
    )]
    pub supersample: Option<u32>,
    /// What is mixed: light, or the stored codes as they are (`raw`; faster, darkens what is mixed)
    #[arg(long, value_enum, default_value = "linear", help_heading = "Light")]
    pub transfer: Mixed,
    /// Make it brighter by EV stops, or darker
    #[arg(
        long,
        value_name = "EV",
        default_value_t = 0.0,
        allow_negative_numbers = true,
        value_parser = exposure,
        help_heading = "Light"
    )]
    pub exposure: f64,

    /// How samples are stored; left out: as exactly as IN's, as far as the format can
    #[arg(long, value_enum, help_heading = "The file")]
    pub depth: Option<Depth>,
    /// Noise of one step before rounding, which hides steps in smooth skies
    #[arg(long, help_heading = "The file")]
    pub dither: bool,
    /// Write all smaller levels too (.ktx2, .dds)
    #[arg(long, help_heading = "The file")]
    pub mips: bool,
    /// Compress with Zstandard (.ktx2)
    #[arg(long, help_heading = "The file")]
    pub zstd: bool,
    /// Quality of a .jpg, 1 to 100
    #[arg(
        long,
        value_name = "Q",
        value_parser = clap::value_parser!(u8).range(1..=100),
        help_heading = "The file"
    )]
    pub quality: Option<u8>,
    /// Mark an .exr as an environment map: latlong, or cube in a column; in OpenEXR's axes with its samples on the charts'
    /// borders, unless told otherwise
    #[arg(long, help_heading = "The file")]
    pub envmap: bool,
    /// Replace existing files
    #[arg(long, help_heading = "The file")]
    pub force: bool,

    /// Print one JSON object: what was done, what was skipped, how long each stage took
    #[arg(long, help_heading = "Measuring")]
    pub json: bool,
    /// Convert N times and report the median time and the spread
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=10_000),
        help_heading = "Measuring"
    )]
    pub repeat: Option<u32>,
    /// Threads; left out: one for each core
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=1024),
        help_heading = "Measuring"
    )]
    pub threads: Option<u32>,
    /// Instructions to use; left out: the best that the processor has
    #[arg(long, value_enum, help_heading = "Measuring")]
    pub isa: Option<IsaName>,
}

const AFTER_HELP: &str = "\
Directions: +x right, +y up, +z ahead, at the middle of a latlong. Cube faces are those of OpenGL, Direct3D, Vulkan.

Examples:
  sixfold convert sky.hdr sky.ktx2 --to cube --mips
  sixfold convert sky.exr face_%f.png --to cube --size 1024
  sixfold convert cross.png latlong.png --to latlong --size 2048
  sixfold convert labelled-faces labels.png --to eac --layout 3x2-turned
  sixfold convert unknown.png --inspect
  sixfold convert in_%04d.exr out_%04d.exr --to ccm
  ffmpeg -i in.mp4 -f rawvideo -pix_fmt rgb24 - |
    sixfold convert - - --raw rgb24 4096x2048 --from latlong --to eac --layout 3x2-turned --size 1024 |
    ffmpeg -f rawvideo -pix_fmt rgb24 -s 3072x2048 -i - out.mp4";

/// Where samples sit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum SamplesAt {
    /// In the middle of their squares
    Centre,
    /// The outermost on the chart's border (OpenEXR's environment maps)
    Edge,
}

impl From<SamplesAt> for Siting {
    fn from(at: SamplesAt) -> Self {
        match at {
            SamplesAt::Centre => Self::Centre,
            SamplesAt::Edge => Self::Edge,
        }
    }
}

/// What the numbers of a file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Numbers {
    /// Light: of a whole number, its share of the largest
    Linear,
    /// Codes of sRGB
    Srgb,
}

impl From<Numbers> for Transfer {
    fn from(numbers: Numbers) -> Self {
        match numbers {
            Numbers::Linear => Self::Linear,
            Numbers::Srgb => Self::Srgb,
        }
    }
}

/// A filter's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct FilterName(pub Filter);

impl ValueEnum for FilterName {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [FilterName; Filter::ALL.len()] = {
            let mut all = [FilterName(Filter::Nearest); Filter::ALL.len()];
            let mut i = 0;
            while i < all.len() {
                all[i] = FilterName(Filter::ALL[i]);
                i += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(self.0.id().into())
    }
}

/// What is mixed when texels are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Mixed {
    /// Light
    Linear,
    /// The stored codes
    Raw,
}

impl From<Mixed> for FilteredIn {
    fn from(mixed: Mixed) -> Self {
        match mixed {
            Mixed::Linear => Self::Light,
            Mixed::Raw => Self::Codes,
        }
    }
}

/// How samples are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Depth {
    /// 8 bits
    #[value(name = "8")]
    Eight,
    /// 16 bits
    #[value(name = "16")]
    Sixteen,
    /// 16 bits, floating
    Half,
    /// 32 bits, floating
    Float,
    /// 9 bits each with a common exponent (.ktx2, .dds)
    Rgb9e5,
}

impl Depth {
    /// How a file stores it.
    pub const fn stored(self) -> Stored {
        match self {
            Self::Eight => Stored::U8,
            Self::Sixteen => Stored::U16,
            Self::Half => Stored::Half,
            Self::Float => Stored::F32,
            Self::Rgb9e5 => Stored::Rgb9e5,
        }
    }
}

/// Sets of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum IsaName {
    /// What every processor of the kind has
    Baseline,
    /// AVX2 and fused multiply-add
    Avx2,
    /// AVX-512
    Avx512,
}

impl IsaName {
    /// The instructions.
    pub const fn isa(self) -> Isa {
        match self {
            Self::Baseline => Isa::Baseline,
            Self::Avx2 => Isa::Avx2,
            Self::Avx512 => Isa::Avx512,
        }
    }

    /// The name of instructions.
    pub const fn of(isa: Isa) -> &'static str {
        match isa {
            Isa::Baseline => "baseline",
            Isa::Avx2 => "avx2",
            Isa::Avx512 => "avx512",
        }
    }
}

/// How a pixel of a raw frame is written, as FFmpeg names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) enum RawFormat {
    /// Codes of sRGB, 8 bits.
    Rgb24,
    /// Codes of sRGB, 16 bits, the low byte first.
    Rgb48le,
    /// Light, 32-bit floats, the low byte first.
    Rgbf32le,
}

impl RawFormat {
    const ALL: [(&str, Self); 3] = [
        ("rgb24", Self::Rgb24),
        ("rgb48le", Self::Rgb48le),
        ("rgbf32le", Self::Rgbf32le),
    ];

    /// The format of that name.
    ///
    /// # Errors
    /// What there is instead.
    pub fn from_id(id: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|(name, _)| *name == id);
        found.map(|(_, format)| *format).ok_or_else(|| {
            let names = Self::ALL.map(|(name, _)| name).join(", ");
            format!("no raw format is called `{id}`; there are {names}")
        })
    }

    /// Number type, meaning and channels of its samples.
    pub const fn kind(self) -> (SampleKind, Transfer, Channels) {
        let (samples, transfer) = match self {
            Self::Rgb24 => (SampleKind::U8, Transfer::Srgb),
            Self::Rgb48le => (SampleKind::U16, Transfer::Srgb),
            Self::Rgbf32le => (SampleKind::F32, Transfer::Linear),
        };
        (samples, transfer, Channels::Rgb)
    }
}

fn exposure(text: &str) -> Result<f64, String> {
    let stops = text.parse::<f64>().ok().filter(|stops| stops.is_finite());
    stops.ok_or_else(|| "must be a number of stops, like -1 or 0.5".to_owned())
}

fn angles(text: &str) -> Result<[f64; 3], String> {
    let numbers = text
        .split(',')
        .map(|word| word.trim().parse::<f64>().ok().filter(|n| n.is_finite()))
        .collect::<Option<Vec<f64>>>();
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| "must be three angles in degrees, like 90,0,-15".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_three_finite_numbers() {
        assert_eq!(angles("-90, 0,1.5"), Ok([-90.0, 0.0, 1.5]));
        for bad in ["", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "a,b,c"] {
            assert!(angles(bad).is_err(), "{bad}");
        }
        assert_eq!(exposure("-1.5"), Ok(-1.5));
        assert!(exposure("inf").is_err() && exposure("bright").is_err());
    }

    #[test]
    fn every_filter_has_its_name() {
        let names: Vec<&str> = FilterName::value_variants()
            .iter()
            .map(|f| f.0.id())
            .collect();
        assert_eq!(names, Filter::ALL.map(Filter::id));
    }
}
