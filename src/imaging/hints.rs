//! What the user says of a map on disk.

use std::fmt;
use std::path::PathBuf;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::{Siting, Transfer};
use crate::mapping::{Arrangement, Frame, Layout, MappingId};

/// What the user says of a map. What is left out is guessed where that is certain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct OpenHints {
    /// The mapping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mapping: Option<MappingId>,
    /// How its charts lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<Layout>,
    /// The program whose orientation it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<&'static Frame>,
    /// What each of six pictures really is, instead of what the frame says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrange: Option<Arrangement>,
    /// Left and right are exchanged all around, whatever else is said.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub mirrored: bool,
    /// Where its samples sit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub siting: Option<Siting>,
    /// How its numbers become light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transfer: Option<Transfer>,
}

impl OpenHints {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The same for `sixfold convert`: options, each with its value where it has one.
    pub fn options(&self) -> Vec<(&'static str, Option<String>)> {
        let siting = |siting| match siting {
            Siting::Centre => "centre",
            Siting::Edge => "edge",
        };
        let transfer = |transfer| match transfer {
            Transfer::Linear => "linear",
            Transfer::Srgb => "srgb",
        };
        let said = [
            ("--from", self.mapping.map(|mapping| mapping.to_string())),
            (
                "--from-layout",
                self.layout.map(|layout| layout.id().to_owned()),
            ),
            ("--from-frame", self.frame.map(|frame| frame.id.to_owned())),
            ("--arrange", self.arrange.map(String::from)),
            ("--from-samples", self.siting.map(siting).map(str::to_owned)),
            (
                "--from-transfer",
                self.transfer.map(transfer).map(str::to_owned),
            ),
        ];
        let said = said.into_iter().filter(|(_, value)| value.is_some());
        let mirrored = self.mirrored.then_some(("--from-mirrored", None));
        said.chain(mirrored).collect()
    }
}

/// A map on disk, and how it is read.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct MapFile {
    /// The file, or one of six.
    pub path: PathBuf,
    /// What is said of it.
    #[serde(skip_serializing_if = "OpenHints::is_empty")]
    pub hints: OpenHints,
}

impl From<PathBuf> for MapFile {
    fn from(path: PathBuf) -> Self {
        Self {
            path,
            hints: OpenHints::default(),
        }
    }
}

/// Earlier scenes have the path alone.
impl<'de> Deserialize<'de> for MapFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Both {
            path: PathBuf,
            #[serde(default)]
            hints: OpenHints,
        }
        struct PathOrBoth;
        impl<'de> Visitor<'de> for PathOrBoth {
            type Value = MapFile;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a path, or a path with hints")
            }

            fn visit_str<E>(self, path: &str) -> Result<MapFile, E> {
                Ok(PathBuf::from(path).into())
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MapFile, A::Error> {
                let Both { path, hints } = Both::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MapFile { path, hints })
            }
        }
        deserializer.deserialize_any(PathOrBoth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<MapFile, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    #[test]
    fn hints_survive_their_file_and_earlier_files_have_none() {
        let file = MapFile {
            path: "sky.png".into(),
            hints: OpenHints {
                mapping: Some(MappingId::Cube),
                layout: Some(Layout::ThreeByTwo),
                frame: Frame::from_id("openexr").ok(),
                arrange: "+x,-x,+y:180,-y,-z:mirrored,+z".parse().ok(),
                mirrored: true,
                siting: Some(Siting::Edge),
                transfer: Some(Transfer::Srgb),
            },
        };
        let text = serde_json::to_string(&file).unwrap();
        assert_eq!(read(&text).unwrap(), file);
        let plain = MapFile::from(PathBuf::from("sky.png"));
        assert_eq!(
            serde_json::to_string(&plain).unwrap(),
            r#"{"path":"sky.png"}"#
        );
        assert_eq!(read(r#""sky.png""#).unwrap(), plain);
        assert_ne!(plain, file);
        let why = read(r#"{"path":"sky.png","hints":{"frame":"elsewhere"}}"#).unwrap_err();
        assert!(why.contains("no frame is called `elsewhere`"), "{why}");
        assert!(read(r#"{"path":"sky.png","hints":{"arrange":"+x"}}"#).is_err());
        assert!(read("{}").is_err());
    }

    #[test]
    fn the_options_say_the_same() {
        let hints = OpenHints {
            mapping: Some(MappingId::Eac),
            layout: Some(Layout::ThreeByTwoTurned),
            siting: Some(Siting::Edge),
            transfer: Some(Transfer::Srgb),
            mirrored: true,
            ..OpenHints::default()
        };
        let words: Vec<String> = hints
            .options()
            .into_iter()
            .flat_map(|(name, value)| std::iter::once(name.to_owned()).chain(value))
            .collect();
        assert_eq!(
            words.join(" "),
            "--from eac --from-layout 3x2-turned --from-samples edge --from-transfer srgb \
             --from-mirrored"
        );
        assert!(OpenHints::default().options().is_empty());
    }
}
