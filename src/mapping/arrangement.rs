//! Which face each of six pictures really is, and how it is turned there.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::cube_face::{FACES, from_frame, to_frame};
use super::{Axes, Turn};

/// A face as a picture shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Held {
    /// The chart: 0 to 5 are +x -x +y -y +z -z.
    pub chart: u32,
    /// How the picture shows it.
    pub turn: Turn,
}

/// For each of the six pictures labelled +x -x +y -y +z -z, in this order, the face that it really is.
///
/// In files it is its text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Arrangement([Held; 6]);

impl Arrangement {
    /// Every picture is the face of its label, upright.
    pub const IDENTITY: Self = Self::upright([0, 1, 2, 3, 4, 5]);

    /// These charts, each upright; must be a permutation.
    pub(crate) const fn upright(charts: [u32; 6]) -> Self {
        let mut held = [Held {
            chart: 0,
            turn: Turn::UPRIGHT,
        }; 6];
        let mut label = 0;
        while label < 6 {
            held[label].chart = charts[label];
            label += 1;
        }
        Self(held)
    }

    /// The arrangement of these faces; `None` unless each chart comes once.
    pub fn new(held: [Held; 6]) -> Option<Self> {
        let is_permutation = (0..6).all(|chart| held.iter().any(|held| held.chart == chart));
        is_permutation.then_some(Self(held))
    }

    /// The faces by label.
    pub const fn held(&self) -> &[Held; 6] {
        &self.0
    }

    /// The label of the picture that shows a chart.
    pub fn label_of(&self, chart: u32) -> Option<usize> {
        self.0.iter().position(|held| held.chart == chart)
    }

    /// The arrangement of a cube map that was drawn with the usual face table, but in other axes.
    ///
    /// Right for every mapping whose warp treats the square's eight symmetries alike (the plain and the equi-angular cube).
    pub fn from_axes(world_from_map: Axes) -> Self {
        // Any point off the square's axes of symmetry tells its turn.
        const PROBE: [f64; 2] = [0.25, 0.5];
        let map_from_world = world_from_map.inverse();
        Self([0, 1, 2, 3, 4, 5].map(|label| {
            let normal = world_from_map.apply(from_frame(label, 0.0, 0.0, 1.0));
            let chart = super::cube_face::largest_component(normal);
            let dir = map_from_world.apply(from_frame(chart, PROBE[0], PROBE[1], 1.0));
            let (sc, tc, _) = to_frame(label, dir);
            let place = PROBE.map(|c| (c + 1.0) / 2.0);
            let turn = Turn::all()
                .find(|turn| turn.cell_place(place) == [(sc + 1.0) / 2.0, (tc + 1.0) / 2.0]);
            Held {
                chart,
                turn: turn.unwrap_or_default(),
            }
        }))
    }

    /// The same for pictures that are labelled by their places, which a program has filled in this order of labels; each
    /// label must come once.
    pub fn by_place(&self, order: [usize; 6]) -> Self {
        Self(order.map(|label| self.0[label]))
    }

    /// The axes of which this is the arrangement, when a signed permutation does it.
    pub fn axes(&self) -> Option<Axes> {
        Axes::all().find(|axes| Self::from_axes(*axes) == *self)
    }

    /// How many pictures are not upright at their own label.
    pub fn changed(&self) -> usize {
        let is_changed = |(label, held): (usize, &Held)| {
            held.chart as usize != label || held.turn != Turn::UPRIGHT
        };
        self.0
            .iter()
            .enumerate()
            .filter(|picture| is_changed(*picture))
            .count()
    }

    /// The faces that the pictures of this arrangement show in a world that another one's axes lead to: first `self`,
    /// then every chart is what `next` says of the label of that name.
    pub fn then(&self, next: &Self) -> Self {
        Self(self.0.map(|held| {
            // next: chart -> picture `held.chart`; self: that picture as a chart -> the picture in the file.
            let inner = next.0[held.chart as usize];
            Held {
                chart: inner.chart,
                turn: inner.turn.then(held.turn),
            }
        }))
    }
}

impl Default for Arrangement {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// `+x,-x,+y:180,-y,-z:mirrored,+z:mirrored:90`: for each picture its face; degrees clockwise, after the exchange of left
/// and right when it is mirrored.
impl fmt::Display for Arrangement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (label, held) in self.0.iter().enumerate() {
            let comma = if label == 0 { "" } else { "," };
            write!(f, "{comma}{}", FACES[held.chart as usize])?;
            if held.turn.is_mirrored() {
                f.write_str(":mirrored")?;
            }
            if held.turn.quarters() != 0 {
                write!(f, ":{}", 90 * u32::from(held.turn.quarters()))?;
            }
        }
        Ok(())
    }
}

impl From<Arrangement> for String {
    fn from(arrangement: Arrangement) -> Self {
        arrangement.to_string()
    }
}

impl TryFrom<String> for Arrangement {
    type Error = ArrangementError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

/// A text that is no arrangement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no arrangement of six faces; write each of +x -x +y -y +z -z once, as in `+x,-x,+y:180,-y,-z:mirrored,+z:mirrored:90`"
)]
pub struct ArrangementError(String);

impl FromStr for Arrangement {
    type Err = ArrangementError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refuse = || ArrangementError(text.to_owned());
        let words: Vec<&str> = text.split(',').map(str::trim).collect();
        let words = <[&str; 6]>::try_from(words).map_err(|_| refuse())?;
        let held = words.map(parse_held);
        let mut faces = Self::IDENTITY.0;
        for (face, held) in faces.iter_mut().zip(held) {
            *face = held.ok_or_else(refuse)?;
        }
        Self::new(faces).ok_or_else(refuse)
    }
}

fn parse_held(word: &str) -> Option<Held> {
    let mut parts = word.split(':').peekable();
    let name = parts.next()?;
    let chart = FACES.iter().position(|face| *face == name)? as u32;
    let mirrored = parts.next_if_eq(&"mirrored").is_some();
    let quarters = match parts.next() {
        None | Some("0") => 0,
        Some("90") => 1,
        Some("180") => 2,
        Some("270") => 3,
        Some(_) => return None,
    };
    parts.next().is_none().then_some(Held {
        chart,
        turn: Turn::new(quarters, mirrored),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_comes_back_and_nonsense_is_refused() {
        for axes in Axes::all() {
            let arrangement = Arrangement::from_axes(axes);
            assert_eq!(arrangement.to_string().parse(), Ok(arrangement));
        }
        let text = "+x,-x,+y:180,-y,-z:mirrored,+z:mirrored:90";
        assert_eq!(text.parse::<Arrangement>().unwrap().to_string(), text);
        for bad in [
            "",
            "+x,-x,+y,-y,+z",
            "+x,-x,+y,-y,+z,+z",
            "+x,-x,+y,-y,+z,-z:45",
            "+x,-x,+y,-y,+z,-z:90:mirrored",
        ] {
            assert!(bad.parse::<Arrangement>().is_err(), "{bad}");
        }
    }

    #[test]
    fn axes_and_arrangements_agree() {
        assert_eq!(
            Arrangement::from_axes(Axes::IDENTITY),
            Arrangement::IDENTITY
        );
        for first in Axes::all() {
            let one = Arrangement::from_axes(first);
            assert_eq!(one.axes(), Some(first));
            let mirrored = one
                .held()
                .iter()
                .filter(|held| held.turn.is_mirrored())
                .count();
            assert_eq!(mirrored, if first.is_mirroring() { 6 } else { 0 });
            for second in Axes::all() {
                let both = Arrangement::from_axes(first.then(second));
                assert_eq!(one.then(&Arrangement::from_axes(second)), both);
            }
        }
        // A picture exchanged without a flip is what no axes do.
        assert_eq!(Arrangement::upright([0, 1, 2, 3, 5, 4]).axes(), None);
    }
}
