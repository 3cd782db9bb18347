//! The answer in words.

use super::{CLEARLY, Solution};
use crate::imaging::detect::MEETS;
use crate::mapping::cube_face::FACES;
use crate::mapping::{Arrangement, Held};

impl Solution {
    /// The answer in one sentence.
    pub fn sentence(&self) -> String {
        let Some(score) = self.score else {
            return "cannot tell: the pictures are all even where they meet".to_owned();
        };
        let what = describe(&self.arrangement);
        if self.is_certain {
            return format!(
                "{what} (seams {score:.2} times as rough as beside them, the next best {:.1} times worse)",
                self.margin
            );
        }
        if score > MEETS {
            return format!(
                "cannot tell: even put together best, the pictures differ {score:.1} times as much across seams as beside them"
            );
        }
        // Of ways that fit alike, the one that the labels say needs no other reason.
        if let Some(as_labelled) = self
            .as_labelled
            .filter(|labelled| *labelled < CLEARLY * score)
        {
            return format!(
                "cannot tell, but every face may be where its name says: no other way fits clearly better (seams {as_labelled:.2} times \
                 as rough as beside them, {score:.2} at best)"
            );
        }
        format!(
            "cannot tell: `{what}` fits best, but another way is only {:.2} times worse",
            self.margin
        )
    }

    /// The other answer that fits as well, in one sentence.
    pub fn mirrored_sentence(&self) -> String {
        format!(
            "or seen in a mirror, which seams cannot tell: {}",
            describe(&self.mirrored)
        )
    }

    /// The answer as an option of `sixfold convert`.
    pub fn option(&self) -> String {
        format!("--arrange \"{}\"", self.arrangement)
    }
}

/// What an arrangement does to plainly labelled pictures.
pub(super) fn describe(arrangement: &Arrangement) -> String {
    let held = arrangement.held();
    let mut parts = moved(held);
    if parts.is_empty() {
        parts.push("every face is where its name says".to_owned());
    }
    let labels = |is: &dyn Fn(&Held) -> bool| -> Vec<&str> {
        (0..6)
            .filter(|label| is(&held[*label]))
            .map(|label| FACES[label])
            .collect()
    };
    let mirrored = labels(&|held| held.turn.is_mirrored());
    parts.push(match mirrored.len() {
        0 => "nothing flipped".to_owned(),
        6 => "all flipped left to right".to_owned(),
        _ => format!("{} flipped left to right", list(&mirrored)),
    });
    for quarters in 1..4 {
        let turned = labels(&|held| held.turn.quarters() == quarters);
        if !turned.is_empty() {
            parts.push(format!(
                "{} turned by {} degrees clockwise",
                list(&turned),
                90 * u32::from(quarters)
            ));
        }
    }
    parts.join(", ")
}

/// Which names are exchanged: pairs, and longer rounds of which each picture shows the next one's face.
fn moved(held: &[Held; 6]) -> Vec<String> {
    let mut parts = Vec::new();
    let mut told = [false; 6];
    for label in 0..6 {
        let mut round = Vec::new();
        let mut next = label;
        while !told[next] {
            told[next] = true;
            round.push(FACES[next]);
            next = held[next].chart as usize;
        }
        match round.as_slice() {
            [] | [_] => {}
            [one, other] => parts.push(format!("faces {one} and {other} exchanged")),
            [first, .., last] => {
                let shown = round
                    .windows(2)
                    .map(|pair| format!("{} shows {}", pair[0], pair[1]));
                let shown: Vec<String> = shown.chain([format!("{last} shows {first}")]).collect();
                parts.push(shown.join(", "));
            }
        }
    }
    parts
}

/// "a", "a and b", "a, b and c".
fn list(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_say_what_is_exchanged() {
        let say = |text: &str| describe(&text.parse().unwrap());
        assert_eq!(
            say("+x,-x,+y,-y,-z,+z"),
            "faces +z and -z exchanged, nothing flipped"
        );
        assert_eq!(
            say("+x,-x,+y,-y,+z,-z"),
            "every face is where its name says, nothing flipped"
        );
        assert_eq!(
            say("+y,-x,+z:90,-y,+x:mirrored,-z:90"),
            "+x shows +y, +y shows +z, +z shows +x, +z flipped left to right, +y and -z turned by 90 degrees clockwise"
        );
    }
}
