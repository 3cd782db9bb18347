//! What a picture may be: mapping and layout from its shape, what its file says, and how well its charts meet.

use super::evenness::{has_empty_corners, is_even};
use super::seams::{Texels, seams};
use super::{EnvmapKind, MapShape, OpenHints, Raster, Siting};
use crate::mapping::{Axes, Domain, Frame, Layout, MappingId};

/// Charts that differ this many times as much across their seams as beside them do not meet.
pub const MEETS: f64 = 4.0;

/// How many times less likely the next proposal must be.
const CLEARLY: f64 = 1.5;

/// A map whose seams are this smooth has the same samples on both sides: they lie on the borders.
const SAME: f64 = 0.3;

/// One way to take a picture.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The mapping.
    pub mapping: MappingId,
    /// How its charts lie.
    pub layout: Layout,
    /// Where the samples sit.
    pub siting: Siting,
    /// Whose orientation it has; `None`: ours.
    pub frame: Option<&'static Frame>,
    /// How the charts meet: 1 as smoothly as the texels inside, larger worse; `None` where that cannot be told.
    pub score: Option<f64>,
    /// Why it is proposed, in a few words.
    pub why: String,
    /// How unlikely it is, all in all: the score, made larger by what speaks against it.
    doubt: f64,
}

impl Proposal {
    /// What someone says of the pictures, not looked at.
    pub(super) fn said(mapping: MappingId, layout: Layout) -> Self {
        Self {
            mapping,
            layout,
            siting: Siting::Centre,
            frame: None,
            score: None,
            why: "as it was said to be".to_owned(),
            doubt: 0.0,
        }
    }

    /// The hints that ask for it; what else was said stays.
    pub fn hints(&self, said: &OpenHints) -> OpenHints {
        OpenHints {
            mapping: Some(self.mapping),
            layout: Some(self.layout),
            frame: self.frame,
            siting: Some(self.siting),
            ..*said
        }
    }

    /// Whether the two differ in nothing that pixels tell, or in whose orientation the faces have.
    pub(super) fn is_laid_like(&self, other: &Self) -> bool {
        self.layout == other.layout
            && (self.mapping == other.mapping || is_sibling(self, other) || is_sibling(other, self))
    }

    /// The shape of the map when the pictures are taken so; `None` when they do not fit.
    pub fn shape(&self, rasters: &[Raster]) -> Option<MapShape> {
        let mut shape = plain_shape(self.mapping, self.layout, rasters)?;
        if let Some(frame) = self.frame {
            shape.apply_frame(frame, self.layout).ok()?;
        }
        shape.siting = self.siting;
        Some(shape)
    }

    /// "latlong: twice as wide as high; seams 1.02".
    pub fn sentence(&self) -> String {
        let layout = match self.layout {
            Layout::Single => String::new(),
            layout => format!(" as `{}`", layout.id()),
        };
        let frame = self
            .frame
            .map(|frame| format!(" of {}", frame.name))
            .unwrap_or_default();
        let score = self.score.map_or_else(
            || "seams tell nothing".to_owned(),
            |score| format!("seams {score:.2}"),
        );
        format!("`{}`{layout}{frame}: {}; {score}", self.mapping, self.why)
    }
}

/// What is known of the pictures beside their texels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// What OpenEXR's attribute says.
    pub envmap: Option<EnvmapKind>,
    /// The file says that it is a cube map.
    pub is_cube: bool,
}

/// The proposals for some pictures.
#[derive(Clone, Debug, Default)]
pub struct Detection {
    /// The likeliest first.
    pub proposals: Vec<Proposal>,
    /// Whether the first one is so much likelier than the others that nobody needs to be asked.
    pub is_certain: bool,
}

impl Detection {
    /// The one to take without asking: the first where that is certain, and a latlong where nothing else is clearly likelier.
    /// Most pictures twice as wide as high are panoramas, whose borders meet badly only in cut ones.
    pub fn taken(&self) -> Option<&Proposal> {
        let first = self.proposals.first()?;
        if self.is_certain {
            return Some(first);
        }
        let mut all = self.proposals.iter();
        let latlong = all.find(|proposal| proposal.mapping == MappingId::Latlong)?;
        (latlong.doubt < CLEARLY * first.doubt).then_some(latlong)
    }
}

/// Proposes what the pictures are: one picture, or six faces.
pub fn detect(rasters: &[Raster], known: Known) -> Detection {
    let mut proposals: Vec<Proposal> = candidates(rasters, known)
        .into_iter()
        .filter_map(|candidate| candidate.judged(rasters))
        .collect();
    proposals.sort_by(|a, b| a.doubt.total_cmp(&b.doubt));
    let is_certain = proposals.first().is_some_and(|first| {
        let is_said = known.envmap.is_some_and(|_| first.frame.is_some()) || known.is_cube;
        let rivals = proposals[1..]
            .iter()
            .filter(|rival| !is_sibling(first, rival));
        let is_alone = rivals
            .into_iter()
            .all(|rival| rival.doubt >= CLEARLY * first.doubt);
        // Discs in a square are told apart by nothing: the sphere map's and the angular map's rims are one direction both.
        let is_disc = first.mapping.info().domain == Domain::Disc && first.layout == Layout::Single;
        is_said || (is_alone && !is_disc && first.doubt <= MEETS)
    });
    Detection {
        proposals,
        is_certain,
    }
}

/// The members of the cube family meet alike at their edges and are laid out alike: a cross or six files are the plain cube
/// unless someone says otherwise.
fn is_sibling(first: &Proposal, other: &Proposal) -> bool {
    first.mapping == MappingId::Cube
        && matches!(other.mapping, MappingId::Eac | MappingId::Ccm)
        && first.layout == other.layout
}

/// The shape of a map of a mapping in a layout, when the pictures have it.
pub(super) fn plain_shape(
    mapping: MappingId,
    layout: Layout,
    rasters: &[Raster],
) -> Option<MapShape> {
    let first = rasters.first()?;
    let [columns, rows] = layout.grid();
    let count = if layout == Layout::Faces {
        mapping.info().chart_count()
    } else {
        1
    };
    let is_whole = first.width().is_multiple_of(columns) && first.height().is_multiple_of(rows);
    if rasters.len() != count as usize || !is_whole {
        return None;
    }
    let size = [first.width() / columns, first.height() / rows];
    Some(MapShape {
        mapping,
        size,
        charts: MapShape::placements(mapping, layout, size)?,
        world_from_map: Axes::IDENTITY,
        siting: Siting::Centre,
        channels: first.channels(),
        samples: first.samples().kind(),
        transfer: first.transfer(),
    })
}

/// What may be proposed, before its texels are looked at.
struct Candidate {
    mapping: MappingId,
    layout: Layout,
    frame: Option<&'static Frame>,
    /// The file itself says so.
    is_said: bool,
    why: &'static str,
    /// How much rarer it is than the commonest of its shape.
    rarity: f64,
}

impl Candidate {
    fn new(mapping: MappingId, layout: Layout, why: &'static str, rarity: f64) -> Self {
        Self {
            mapping,
            layout,
            frame: None,
            is_said: false,
            why,
            rarity,
        }
    }

    fn judged(self, rasters: &[Raster]) -> Option<Proposal> {
        // What a picture's empty or full corners speak against.
        const AGAINST: f64 = 4.0;
        // Pictures in which nothing can be told are neither smooth nor rough.
        const UNTOLD: f64 = 1.0;
        let mut proposal = Proposal {
            mapping: self.mapping,
            layout: self.layout,
            siting: Siting::Centre,
            frame: self.frame,
            score: None,
            why: self.why.to_owned(),
            doubt: 0.0,
        };
        let shape = proposal.shape(rasters)?;
        if self.mapping.info().chart_count() == 6 && shape.size[0] != shape.size[1] {
            return None;
        }
        proposal.score = seams(&shape, rasters).and_then(|seams| seams.score());
        let is_same = proposal.score.is_some_and(|score| score < SAME);
        let has_borders = matches!(self.mapping, MappingId::Cube | MappingId::Latlong);
        let has_poles = || self.mapping != MappingId::Latlong || has_poles(&shape, rasters);
        if (is_same && has_borders && has_poles())
            || (self.is_said && self.frame.is_some_and(|frame| frame.is_edge_sited))
        {
            proposal.siting = Siting::Edge;
        }
        let mut doubt = proposal.score.unwrap_or(UNTOLD).max(UNTOLD) * self.rarity;
        if let Some(against) = speaks_against(&shape, self.layout, rasters) {
            doubt *= AGAINST;
            proposal.why = format!("{}, but {against}", proposal.why);
        }
        proposal.doubt = doubt;
        Some(proposal)
    }
}

/// Whether the first and last rows of a latlong are one direction each, as they are where samples lie on the border. Columns alone do
/// not tell: what is symmetric about the date line is the same on both sides of it.
fn has_poles(shape: &MapShape, rasters: &[Raster]) -> bool {
    // Rings around a pole of half a texel and of one and a half differ by three times as much as they are apart; a point by nothing.
    const POINT: f32 = 0.1;
    let texels = Texels { shape, rasters };
    let [width, height] = shape.size;
    let spread = |row: u32| {
        let (mut least, mut most) = ([f32::MAX; 3], [f32::MIN; 3]);
        for column in 0..width {
            let light = texels.lightness((0, [column, row])).unwrap_or_default();
            least = [0, 1, 2].map(|c| least[c].min(light[c]));
            most = [0, 1, 2].map(|c| most[c].max(light[c]));
        }
        (0..3).map(|c| most[c] - least[c]).sum::<f32>()
    };
    let is_point = |row: u32, next: u32| spread(row) < POINT * spread(next);
    height >= 4 && is_point(0, 1) && is_point(height - 1, height - 2)
}

/// What in the parts that no chart uses speaks against a shape.
fn speaks_against(shape: &MapShape, layout: Layout, rasters: &[Raster]) -> Option<&'static str> {
    let raster = rasters.first()?;
    let info = shape.mapping.info();
    if matches!(
        layout,
        Layout::Cross | Layout::VerticalCross | Layout::VerticalCrossUpright
    ) {
        let [columns, rows] = layout.grid();
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        let mut empty = cells.filter(|at| layout.cells().iter().all(|cell| cell.at != *at));
        let is_empty =
            empty.all(|at| is_even(raster, [0, 1].map(|i| at[i] * shape.size[i]), shape.size));
        return (!is_empty).then_some("its corners are not empty");
    }
    let parts = shape.charts.iter().flatten();
    let are_discs = parts.into_iter().all(|part| {
        let raster = &rasters[part.raster.min(rasters.len() - 1)];
        has_empty_corners(raster, part.origin, shape.size)
    });
    match info.domain {
        Domain::Disc if !are_discs => Some("its corners are not empty"),
        Domain::Square if are_discs && is_disc_like(shape, rasters) => {
            Some("its corners are empty")
        }
        // Two discs side by side: each half has four empty corners.
        Domain::Square if shape.mapping == MappingId::Latlong && has_two_discs(raster) => {
            Some("its halves have empty corners")
        }
        _ => None,
    }
}

/// Whether what is outside of the discs is empty while what is inside is not.
fn is_disc_like(shape: &MapShape, rasters: &[Raster]) -> bool {
    let mut parts = shape.charts.iter().flatten();
    parts.any(|part| {
        !is_even(
            &rasters[part.raster.min(rasters.len() - 1)],
            part.origin,
            shape.size,
        )
    })
}

fn has_two_discs(raster: &Raster) -> bool {
    let size = [raster.width() / 2, raster.height()];
    let halves = [[0, 0], [size[0], 0]];
    size[0] > 0
        && halves.iter().all(|at| has_empty_corners(raster, *at, size))
        && halves.iter().any(|at| !is_even(raster, *at, size))
}

/// What pictures of such a shape are, from the commonest to the rarest.
fn candidates(rasters: &[Raster], known: Known) -> Vec<Candidate> {
    use MappingId::{
        Angular, Ccm, Cube, CylindricalEqualArea, Eac, Latlong, Matcap, Octahedral,
        OctahedralEqualArea, Paraboloid, Sphere,
    };
    let Some(first) = rasters.first() else {
        return Vec::new();
    };
    let openexr = Frame::from_id("openexr").ok();
    let said = |mapping, layout, why| Candidate {
        frame: openexr,
        is_said: true,
        ..Candidate::new(mapping, layout, why, 1.0)
    };
    let family = |layout, why| {
        [(Cube, 1.0), (Eac, 1.6), (Ccm, 1.8)]
            .map(|(mapping, rarity)| Candidate::new(mapping, layout, why, rarity))
    };
    if rasters.len() > 1 {
        let why = if known.is_cube {
            "the file says that it is a cube map"
        } else {
            "six pictures"
        };
        return family(Layout::Faces, why).into();
    }
    match known.envmap {
        Some(EnvmapKind::Latlong) => {
            return vec![said(
                Latlong,
                Layout::Single,
                "the file says that it is a latlong",
            )];
        }
        Some(EnvmapKind::Cube) if first.height() == 6 * first.width() => {
            return vec![said(
                Cube,
                Layout::Column,
                "the file says that it is a cube",
            )];
        }
        _ => {}
    }
    let [width, height] = first.size().map(u64::from);
    let is = |w: u64, h: u64| width * h == height * w;
    let mut found = Vec::new();
    if is(4, 3) {
        found.extend(family(
            Layout::Cross,
            "4 to 3, a horizontal cross of six squares",
        ));
    }
    if is(3, 4) {
        found.extend(family(
            Layout::VerticalCross,
            "3 to 4, a vertical cross of six squares, -z upside down",
        ));
        found.extend(family(
            Layout::VerticalCrossUpright,
            "3 to 4, a vertical cross of six squares, -z upright",
        ));
    }
    if is(6, 1) {
        found.extend(family(Layout::Row, "6 to 1, six squares in a row"));
    }
    if is(1, 6) {
        found.extend(family(Layout::Column, "1 to 6, six squares in a column"));
        found.push(Candidate {
            frame: openexr,
            ..Candidate::new(
                Cube,
                Layout::Column,
                "1 to 6, six squares in a column, +z and -z exchanged",
                1.0,
            )
        });
    }
    if is(3, 2) {
        found.extend(family(
            Layout::ThreeByTwo,
            "3 to 2, two rows of three squares",
        ));
        let why = "3 to 2, two rows of three squares, the lower ones turned as in 360-degree video";
        found.push(Candidate::new(Eac, Layout::ThreeByTwoTurned, why, 1.0));
    }
    // A texel or two more or less come from scaling.
    if width.abs_diff(2 * height) <= 2 {
        found.push(Candidate::new(
            Latlong,
            Layout::Single,
            "twice as wide as high",
            1.0,
        ));
    }
    if is(2, 1) {
        found.push(Candidate::new(
            Paraboloid,
            Layout::Pair,
            "two squares side by side",
            2.0,
        ));
    }
    if is(1, 2) {
        found.push(Candidate::new(
            Paraboloid,
            Layout::PairColumn,
            "two squares, one above the other",
            1.0,
        ));
    }
    if is(1, 1) {
        for (mapping, why, rarity) in [
            (Octahedral, "a square", 1.0),
            (OctahedralEqualArea, "a square", 1.1),
            (Sphere, "a disc in a square", 1.0),
            (Angular, "a disc in a square", 1.0),
            (Matcap, "a disc in a square", 1.2),
        ] {
            found.push(Candidate::new(mapping, Layout::Single, why, rarity));
        }
    }
    let aspect = CylindricalEqualArea.info().aspect;
    if (width as f64 - aspect * height as f64).abs() <= 2.0 {
        found.push(Candidate::new(
            CylindricalEqualArea,
            Layout::Single,
            "pi times as wide as high",
            1.0,
        ));
    }
    found
}
