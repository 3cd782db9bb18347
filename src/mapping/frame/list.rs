//! The programs, one after another, and what is known of each.

use super::{CubeFrame, Founded, Frame, Pictures};
use crate::mapping::{Arrangement, Axes, Layout, MappingId};

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

pub(super) const FRAMES: &[Frame] = &[
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
