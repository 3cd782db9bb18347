//! Which way round other programs have it: their axes in our world, their cube faces, their latlong pictures.
//!
//! Two things are said of each program. How its axes lie in our left-handed world (x right, y up, z forward): a program
//! with right-handed axes and y up has its (x, y, z) at our (x, y, -z), one with z up at our (x, z, y), so that nothing
//! that is seen from inside becomes its mirror image. And how its pictures lie in its own axes. From both follows where
//! its pictures lie in our world; [`Frame::is_mirrored`] tells where that mirrors them after all.

mod list;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::{Arrangement, Axes, Layout, MappingId};

/// How well a frame's facts are founded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Founded {
    /// The program was run on a picture whose texels hold their own directions.
    Run,
    /// The specification, the documentation or the program's source was read.
    Read,
    /// From a secondary source.
    Unverified,
}

impl Founded {
    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Run => "checked by running it",
            Self::Read => "read in its source or documentation",
            Self::Unverified => "not verified",
        }
    }
}

/// What a program's six pictures are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pictures {
    /// They are looked up by the usual face table with this direction, made from a direction in the program's axes.
    LookedUp(Axes),
    /// They show these faces of our world.
    Drawn(Arrangement),
}

/// A program's cube maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CubeFrame {
    /// What the pictures labelled +x -x +y -y +z -z are.
    pub pictures: Pictures,
    /// The program's own names of them, in the order of these labels.
    pub names: [&'static str; 6],
    /// The labels, 0 to 5, in the order in which the program puts them into a row, a column or an array.
    pub order: [usize; 6],
    /// How the program usually lays them out.
    pub layout: Layout,
}

/// A program's way to have environment maps.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct Frame {
    /// Name on the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// How its axes lie in our world, and what is peculiar to it.
    pub about: &'static str,
    /// Where that is known from.
    pub source: &'static str,
    /// How well.
    pub founded: Founded,
    /// Our direction from one in the program's axes.
    pub world_from_program: Axes,
    /// Its cube maps; `None` where it has none of its own, or nothing is known.
    pub cube: Option<CubeFrame>,
    /// For each single-chart mapping of which something is known: the program's direction from the map's own.
    pub program_from_map: &'static [(MappingId, Axes)],
    /// Whether it is this program: nothing is turned, whatever the mapping.
    pub is_ours: bool,
    /// Whether its samples sit on the charts' borders instead of in the middle of their squares.
    pub is_edge_sited: bool,
}

/// By its id.
impl Serialize for Frame {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.id)
    }
}

impl<'de> Deserialize<'de> for &'static Frame {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let id = String::deserialize(deserializer)?;
        Frame::from_id(&id).map_err(de::Error::custom)
    }
}

/// A frame that says nothing of a mapping.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{frame} has no way of its own to lay out `{mapping}`; leave the frame out, or name one of: {others}"
)]
pub struct FrameError {
    frame: &'static str,
    mapping: MappingId,
    others: String,
}

/// No frame has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no frame is called `{0}`; there are: {names}", names = Frame::names())]
pub struct UnknownFrame(String);

impl Frame {
    /// Every frame.
    pub const ALL: &'static [Self] = list::FRAMES;

    /// The frame with this id.
    ///
    /// # Errors
    /// When there is none.
    pub fn from_id(id: &str) -> Result<&'static Self, UnknownFrame> {
        let found = Self::ALL.iter().find(|frame| frame.id == id);
        found.ok_or_else(|| UnknownFrame(id.to_owned()))
    }

    /// The ids, separated by spaces.
    fn names() -> String {
        Self::ALL
            .iter()
            .map(|frame| frame.id)
            .collect::<Vec<_>>()
            .join(" ")
    }

    /// Whether it says how a map of this mapping lies.
    pub fn knows(&self, mapping: MappingId) -> bool {
        match mapping.info().chart_count() {
            6 => self.cube.is_some(),
            _ => self.world_from_map(mapping).is_some(),
        }
    }

    /// The labels of its six pictures in the order in which they lie in a layout. Where the cells stand for the labels, as in
    /// a cross or six files, there is none.
    pub fn order(&self, layout: Layout) -> Option<[usize; 6]> {
        let is_ordered = matches!(layout, Layout::Row | Layout::Column | Layout::ThreeByTwo);
        self.cube.filter(|_| is_ordered).map(|cube| cube.order)
    }

    /// The faces of our world that its six pictures show.
    pub fn arrangement(&self) -> Option<Arrangement> {
        Some(match self.cube?.pictures {
            Pictures::Drawn(arrangement) => arrangement,
            Pictures::LookedUp(cube_from_program) => {
                Arrangement::from_axes(cube_from_program.inverse().then(self.world_from_program))
            }
        })
    }

    /// Our world from the own directions of its map of a single chart.
    pub fn world_from_map(&self, mapping: MappingId) -> Option<Axes> {
        if self.is_ours {
            return Some(Axes::IDENTITY);
        }
        let known = self
            .program_from_map
            .iter()
            .find(|(known, _)| *known == mapping)?;
        Some(known.1.then(self.world_from_program))
    }

    /// Whether the program's map of this mapping, seen from inside, is a mirror image in our world.
    pub fn is_mirrored(&self, mapping: MappingId) -> bool {
        if mapping.info().chart_count() == 6 {
            let arrangement = self.arrangement().unwrap_or_default();
            arrangement
                .held()
                .iter()
                .any(|held| held.turn.is_mirrored())
        } else {
            self.world_from_map(mapping).is_some_and(Axes::is_mirroring)
        }
    }

    /// What to say to someone who asks this frame for a mapping that it does not know.
    pub fn unknown(&self, mapping: MappingId) -> FrameError {
        let others: Vec<&str> = Self::ALL
            .iter()
            .filter(|frame| frame.knows(mapping))
            .map(|frame| frame.id)
            .collect();
        FrameError {
            frame: self.name,
            mapping,
            others: if others.is_empty() {
                "none".to_owned()
            } else {
                others.join(" ")
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::ChartPoint;
    use crate::math::Vec3;

    fn frame(id: &str) -> &'static Frame {
        Frame::from_id(id).unwrap()
    }

    #[test]
    fn latlong_pictures_show_what_their_programs_say() {
        // Research table: the program's directions at u = 1/2 and u = 3/4 of the middle row, and at the top.
        let rows: [(&str, [[f64; 3]; 3]); 9] = [
            (
                "openexr",
                [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ),
            (
                "oiio-z-up",
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            ),
            (
                "mitsuba",
                [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ),
            ("cmft", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
            (
                "threejs",
                [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
            ),
            (
                "blender",
                [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
            ),
            (
                "skylibs",
                [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ),
            (
                "godot",
                [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ),
            (
                "unreal",
                [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            ),
        ];
        for (id, dirs) in rows {
            let frame = frame(id);
            let map_from_world = frame.world_from_map(MappingId::Latlong).unwrap().inverse();
            let places = [(0.5, 0.5), (0.75, 0.5), (0.5, 0.0)];
            for (dir, (u, v)) in dirs.into_iter().zip(places) {
                let world = frame.world_from_program.apply(Vec3::from_f64(dir));
                let dir = map_from_world.apply(world);
                let point: ChartPoint<f64> = MappingId::Latlong.forward(dir).unwrap();
                let is_there =
                    (point.v - v).abs() < 1e-12 && (v == 0.0 || (point.u - u).abs() < 1e-12);
                assert!(is_there, "{id}: {dir:?} at {point:?}");
            }
        }
    }

    #[test]
    fn only_those_that_say_so_mirror() {
        for frame in Frame::ALL {
            let maps = frame.program_from_map.iter().map(|(mapping, _)| *mapping);
            let cube = frame.cube.map(|_| MappingId::Cube);
            let mirrored: Vec<MappingId> = maps
                .chain(cube)
                .filter(|mapping| frame.is_mirrored(*mapping))
                .collect();
            let expected: &[MappingId] = match frame.id {
                "godot" => &[MappingId::Cube],
                "oiio-z-up" => &[MappingId::Latlong],
                "pbrt" => &[MappingId::OctahedralEqualArea],
                _ => &[],
            };
            assert_eq!(mirrored, expected, "{}", frame.id);
            if !expected.is_empty() {
                assert!(frame.about.contains("mirror"), "{}", frame.id);
            }
        }
    }

    #[test]
    fn cubes_are_what_is_known_of_them() {
        let text = |id: &str| frame(id).arrangement().unwrap().to_string();
        for id in [
            "opengl",
            "d3d",
            "vulkan",
            "webgpu",
            "unity",
            "bevy",
            "ffmpeg",
            "cmft",
            "py360convert",
        ] {
            assert_eq!(text(id), "+x,-x,+y,-y,+z,-z", "{id}");
        }
        assert_eq!(text("openexr"), "+x,-x,+y,-y,-z,+z");
        assert_eq!(text("threejs"), "-x,+x,+y:180,-y:180,-z,+z");
        assert_eq!(frame("blender").arrangement(), None);
        // Looked up with its own vector: the pictures of the four sides lie on their sides or upside down.
        let unreal = frame("unreal").arrangement().unwrap();
        assert_eq!(unreal.to_string(), "+z:270,-z:90,+x:180,-x,+y:270,-y:270");
    }

    #[test]
    fn a_program_shows_one_world_in_both_of_its_forms() {
        // OpenEXR's own tool turns its latlong into its cube: measured on a latlong of colours (x, y, z) with +z in the
        // middle, the six pictures came out as our faces -x, +x, +y and -y half round, +z, -z.
        let measured: Arrangement = "-x,+x,+y:180,-y:180,+z,-z".parse().unwrap();
        let exr = frame("openexr");
        let latlong = exr.world_from_map(MappingId::Latlong).unwrap();
        assert_eq!(
            measured.then(&Arrangement::from_axes(latlong)),
            exr.arrangement().unwrap()
        );
        assert_ne!(measured, exr.arrangement().unwrap());
    }

    #[test]
    fn orders_are_permutations_and_names_differ() {
        for (i, frame) in Frame::ALL.iter().enumerate() {
            assert!(Frame::ALL[..i].iter().all(|other| other.id != frame.id));
            assert!(
                frame.cube.is_some() || !frame.program_from_map.is_empty(),
                "{}",
                frame.id
            );
            if let Some(cube) = frame.cube {
                assert!(
                    (0..6).all(|label| cube.order.contains(&label)),
                    "{}",
                    frame.id
                );
                assert!(cube.layout.holds(6));
            }
        }
        let error = Frame::from_id("maya").unwrap_err().to_string();
        assert!(
            error.contains("maya") && error.contains("openexr"),
            "{error}"
        );
        let error = frame("bevy").unknown(MappingId::Latlong).to_string();
        assert!(
            error.contains("Bevy") && error.contains("blender"),
            "{error}"
        );
    }

    #[test]
    fn pbrt_looks_up_at_the_middle_of_its_square() {
        let pbrt = frame("pbrt");
        let axes = pbrt.world_from_map(MappingId::OctahedralEqualArea).unwrap();
        let at = |u, v| {
            let dir: Vec3<f64> = MappingId::OctahedralEqualArea
                .inverse(ChartPoint::new(0, u, v))
                .unwrap();
            let program = pbrt.world_from_program.inverse().apply(axes.apply(dir));
            program.to_f64()
        };
        assert_eq!(at(0.5, 0.5)[2], 1.0);
        assert!(at(0.9, 0.5)[0] > 0.5 && at(0.5, 0.9)[1] > 0.5);
    }
}
