//! Which way round other programs have it: their axes in our world, their cube faces, their latlong pictures.
//!
//! Two things are said of each program. How its axes lie in our left-handed world (x right, y up, z forward): a program
//! with right-handed axes and y up has its (x, y, z) at our (x, y, -z), one with z up at our (x, z, y), so that nothing
//! that is seen from inside becomes its mirror image. And how its pictures lie in its own axes. From both follows where
//! its pictures lie in our world; [`Frame::is_mirrored`] tells where that mirrors them after all.

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
    pub const ALL: &'static [Self] = FRAMES;

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

// Axes by number, negative with a minus.
const X: i8 = 1;
const Y: i8 = 2;
const Z: i8 = 3;

/// The program's axes are ours.
const OURS: Axes = Axes::IDENTITY;
/// Right-handed, y up.
const RIGHT_HANDED: Axes = Axes::from_signed([X, Y, -Z]);
/// Right-handed, z up, y forward.
const Z_UP: Axes = Axes::from_signed([X, Z, Y]);

/// A latlong picture by the program's directions at its middle, a quarter to the right of it, and at its top. Our latlong
/// has +z, +x and +y there.
const fn latlong(centre: i8, right: i8, up: i8) -> (MappingId, Axes) {
    (
        MappingId::Latlong,
        Axes::from_signed([right, up, centre]).inverse(),
    )
}

const LABELS: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// Six pictures in the usual order, looked up with this direction.
const fn looked_up(cube_from_program: Axes) -> Option<CubeFrame> {
    Some(CubeFrame {
        pictures: Pictures::LookedUp(cube_from_program),
        names: LABELS,
        order: [0, 1, 2, 3, 4, 5],
        layout: Layout::Faces,
    })
}

/// The part that a frame may leave out.
const PLAIN: Frame = Frame {
    id: "",
    name: "",
    about: "",
    source: "",
    founded: Founded::Read,
    world_from_program: OURS,
    cube: None,
    program_from_map: &[],
    is_ours: false,
    is_edge_sited: false,
};

const FRAMES: &[Frame] = &[
    // For a file that says of itself what is not so.
    Frame {
        id: "sixfold",
        name: "Sixfold's own",
        about: "left-handed: x right, y up, z ahead, at the middle of a latlong; its cube maps are the usual ones",
        source: "this program",
        founded: Founded::Run,
        cube: looked_up(OURS),
        is_ours: true,
        ..PLAIN
    },
    Frame {
        id: "opengl",
        name: "OpenGL",
        about: "cube maps are looked up in left-handed axes, which are ours; it has no latlong of its own",
        source: "OpenGL 4.6, table of cube map faces",
        cube: looked_up(OURS),
        ..PLAIN
    },
    Frame {
        id: "d3d",
        name: "Direct3D",
        about: "its axes are ours; it has no latlong of its own",
        source: "Direct3D 11.3 functional specification, cube maps",
        cube: looked_up(OURS),
        ..PLAIN
    },
    Frame {
        id: "vulkan",
        name: "Vulkan",
        about: "cube maps are looked up in left-handed axes, which are ours; it has no latlong of its own",
        source: "Vulkan specification, cube map face selection; KTX 2 has the same, orientation `rd`",
        cube: looked_up(OURS),
        ..PLAIN
    },
    Frame {
        id: "webgpu",
        name: "WebGPU",
        about: "cube maps are looked up in left-handed axes, which are ours; it has no latlong of its own",
        source: "WebGPU, note on cube texture views",
        cube: looked_up(OURS),
        ..PLAIN
    },
    // Its face table differs from the usual one in that +z and -z are exchanged; with its z at our -z nothing else is left.
    Frame {
        id: "openexr",
        name: "OpenEXR",
        about: "right-handed, y up: its z is our -z; its cube is ours with the pictures +z and -z exchanged and none \
                turned; its samples lie on the borders",
        source: "ImfEnvmap.h; exrenvmap 3.1 run on a latlong of directions, to a cube and back",
        founded: Founded::Run,
        world_from_program: RIGHT_HANDED,
        cube: Some(CubeFrame {
            pictures: Pictures::Drawn(Arrangement::upright([0, 1, 2, 3, 5, 4])),
            names: ["+X", "-X", "+Y", "-Y", "+Z", "-Z"],
            order: [0, 1, 2, 3, 4, 5],
            layout: Layout::Column,
        }),
        program_from_map: &[latlong(Z, -X, Y)],
        is_ours: false,
        is_edge_sited: true,
    },
    Frame {
        id: "oiio",
        name: "OpenImageIO, y up",
        about: "right-handed, y up: its z is our -z; the same as OpenEXR, with samples in the middle of their squares \
                unless `oiio:sampleborder` says otherwise",
        source: "OpenImageIO, environment.cpp, vector_to_latlong (the prose of its manual says +X at the middle)",
        world_from_program: RIGHT_HANDED,
        program_from_map: &[latlong(Z, -X, Y)],
        ..PLAIN
    },
    // Facing +x with z up, -y is on the right in right-handed axes; the code has +y there.
    Frame {
        id: "oiio-z-up",
        name: "OpenImageIO, z up",
        about: "right-handed, z up, y forward: its (x, y, z) is our (x, z, y); the picture is mirrored against its own \
                form for y up",
        source: "OpenImageIO, environment.cpp, vector_to_latlong",
        world_from_program: Z_UP,
        program_from_map: &[latlong(X, Y, Z)],
        ..PLAIN
    },
    Frame {
        id: "mitsuba",
        name: "Mitsuba 3",
        about: "right-handed, y up: its z is our -z",
        source: "mitsuba3, emitters/envmap.cpp: u = atan2(x, -z)/2pi",
        world_from_program: RIGHT_HANDED,
        program_from_map: &[latlong(Z, -X, Y)],
        ..PLAIN
    },
    // The numbers are the mirror image of OpenEXR's, but so are the axes: its own face table is the usual left-handed one.
    Frame {
        id: "cmft",
        name: "cmft",
        about: "left-handed, its axes are ours; read as right-handed numbers its latlong is the mirror image of OpenEXR's",
        source: "cmft, cubemaputils.h: latLongFromVec and s_faceUvVectors",
        cube: looked_up(OURS),
        program_from_map: &[latlong(Z, X, Y)],
        ..PLAIN
    },
    Frame {
        id: "skylibs",
        name: "skylibs",
        about: "right-handed, y up: its z is our -z; its latlong and its angular map are ours",
        source: "skylibs, envmap/projections.py: latlong2world, world2angular",
        world_from_program: RIGHT_HANDED,
        program_from_map: &[
            latlong(-Z, X, Y),
            (MappingId::Angular, Axes::from_signed([X, Y, -Z])),
        ],
        ..PLAIN
    },
    // EqualAreaSquareToSphere: x to the right of the square, y down it, z up at its middle; our map has x, z and y there.
    // That is the sphere's inside seen by right-handed eyes, while pbrt's axes are left-handed.
    Frame {
        id: "pbrt",
        name: "pbrt-v4",
        about: "left-handed, z up: its (x, y, z) is our (x, z, -y); its square is drawn as from outside, mirrored in our world",
        source: "pbrt-v4, util/math.cpp: EqualAreaSquareToSphere; the book, 3.1 (left-handed)",
        world_from_program: Axes::from_signed([X, Z, -Y]),
        program_from_map: &[(MappingId::OctahedralEqualArea, Axes::from_signed([X, Z, Y]))],
        ..PLAIN
    },
    // Looked up with x negated: the cube that it shows is ours turned half round.
    Frame {
        id: "threejs",
        name: "three.js",
        about: "right-handed, y up: its z is our -z; cube textures are looked up with x negated, which turns the usual cube \
                half round against its world",
        source: "three.js, envmap_fragment (flipEnvMap) and common: equirectUv",
        world_from_program: RIGHT_HANDED,
        cube: looked_up(Axes::from_signed([-X, Y, Z])),
        program_from_map: &[latlong(X, Z, Y)],
        ..PLAIN
    },
    Frame {
        id: "blender",
        name: "Blender",
        about: "right-handed, z up, y forward: its (x, y, z) is our (x, z, y); it has no cube maps",
        source: "Cycles, kernel/camera/projection.h: direction_to_equirectangular",
        world_from_program: Z_UP,
        program_from_map: &[latlong(X, -Y, Z)],
        ..PLAIN
    },
    Frame {
        id: "unity",
        name: "Unity",
        about: "its axes are ours",
        source: "Unity manual, CubemapFace; built-in shader Skybox/Panoramic: ToRadialCoords",
        cube: looked_up(OURS),
        program_from_map: &[latlong(X, -Z, Y)],
        ..PLAIN
    },
    // The importer goes from the usual table to the engine's vectors by exchanging y and z, and reads the latlong with the
    // usual vector; so a texture is looked up with the engine's vector as it is, and the latlong's top is +z.
    Frame {
        id: "unreal",
        name: "Unreal Engine",
        about: "left-handed, x forward, y right, z up: its (x, y, z) is our (z, x, y); cube textures are looked up with its \
                vector as it is, so that the usual pictures lie turned",
        source: "Unreal Engine, TextureDerivedDataTask and TextureCompressorModule: LookupLongLat, \
                 TransformSideToWorldSpace; that materials look up with the plain vector is not verified",
        founded: Founded::Unverified,
        world_from_program: Axes::from_signed([Y, Z, X]),
        cube: looked_up(OURS),
        program_from_map: &[latlong(-Y, X, Z)],
        ..PLAIN
    },
    // The documented sky shader looks up with EYEDIR, right-handed as it is: pictures drawn the usual way appear mirrored.
    Frame {
        id: "godot",
        name: "Godot",
        about: "right-handed, y up: its z is our -z; cube maps are looked up with its vector as it is, so that its six \
                pictures are mirror images of the usual ones",
        source: "Godot manual, Cubemap; renderer, sky.glsl: panorama_coords",
        world_from_program: RIGHT_HANDED,
        cube: looked_up(OURS),
        program_from_map: &[latlong(Z, -X, Y)],
        ..PLAIN
    },
    Frame {
        id: "bevy",
        name: "Bevy",
        about: "right-handed, y up: its z is our -z; cube textures are looked up with z negated, so that the usual pictures \
                lie upright; it has no latlong of its own",
        source: "Bevy, skybox.wgsl and environment_map.wgsl",
        world_from_program: RIGHT_HANDED,
        cube: looked_up(Axes::from_signed([X, Y, -Z])),
        ..PLAIN
    },
    Frame {
        id: "ffmpeg",
        name: "FFmpeg v360",
        about: "front, right and up are our +z, +x and +y; its order letters `rludfb` are our charts in our order, all \
                upright; its `eac` is the layout `3x2-turned`",
        source: "ffmpeg 5.1, v360 run from a latlong of directions to c6x1, c3x2, c1x6 and eac, and with each letter first",
        founded: Founded::Run,
        cube: Some(CubeFrame {
            pictures: Pictures::LookedUp(OURS),
            names: ["r", "l", "u", "d", "f", "b"],
            order: [0, 1, 2, 3, 4, 5],
            layout: Layout::ThreeByTwo,
        }),
        program_from_map: &[latlong(Z, X, Y)],
        ..PLAIN
    },
    Frame {
        id: "py360convert",
        name: "py360convert",
        about: "front, right and up are our +z, +x and +y; its rows are in the order F R B L U D; its dice is our cross",
        source: "py360convert 1.0.4, e2c run on a latlong of directions, formats list, dict, horizon and dice",
        founded: Founded::Run,
        cube: Some(CubeFrame {
            pictures: Pictures::LookedUp(OURS),
            names: ["R", "L", "U", "D", "F", "B"],
            order: [4, 0, 5, 1, 2, 3],
            layout: Layout::Cross,
        }),
        program_from_map: &[latlong(Z, X, Y)],
        ..PLAIN
    },
];

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
