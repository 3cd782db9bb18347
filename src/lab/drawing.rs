//! A drawing of lines, discs and words, as SVG and as pixels.

use std::fmt::Write as _;

use crate::imaging::computed::strokes::Strokes;

/// Red, green and blue, 8 bits sRGB.
pub type Colour = [u8; 3];

/// One part of a drawing; places and lengths in pixels, x to the right, y down.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Lines from point to point.
    Line {
        /// The points.
        points: Vec<[f64; 2]>,
        /// How wide the pen is.
        width: f64,
        /// Its ink.
        colour: Colour,
    },
    /// A filled circle.
    Disc {
        /// Its middle.
        at: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Its ink.
        colour: Colour,
    },
    /// Words in one line.
    Words {
        /// Their upper left corner.
        at: [f64; 2],
        /// Height of the letters.
        size: f64,
        /// What they say.
        text: String,
        /// Their ink.
        colour: Colour,
    },
}

/// From one letter of the strokes to the next, over the letters' height; fonts have less, on the average.
const ADVANCE: f64 = 0.8;

/// Width of words of letter height `size` as strokes.
pub fn width(words: &str, size: f64) -> f64 {
    ADVANCE * size * words.chars().count() as f64
}

/// Shapes on white paper, the last on top.
#[derive(Clone, Debug)]
pub struct Drawing {
    size: [u32; 2],
    shapes: Vec<Shape>,
}

impl Drawing {
    /// An empty sheet of `size` pixels.
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            shapes: Vec::new(),
        }
    }

    /// Pixels across and down.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The shapes, the last on top.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Lines from point to point.
    pub fn line(&mut self, points: &[[f64; 2]], width: f64, colour: Colour) {
        self.shapes.push(Shape::Line {
            points: points.to_vec(),
            width,
            colour,
        });
    }

    /// A disc.
    pub fn disc(&mut self, at: [f64; 2], radius: f64, colour: Colour) {
        self.shapes.push(Shape::Disc { at, radius, colour });
    }

    /// Words of letter height `size` whose upper left corner is `at`.
    pub fn words(&mut self, text: &str, at: [f64; 2], size: f64, colour: Colour) {
        self.shapes.push(Shape::Words {
            at,
            size,
            text: text.to_owned(),
            colour,
        });
    }

    /// The same with the middle of the words' upper edge at `at`, as nearly as their width is known: fonts differ.
    pub fn words_below(&mut self, text: &str, at: [f64; 2], size: f64, colour: Colour) {
        self.words(text, [at[0] - 0.5 * width(text, size), at[1]], size, colour);
    }

    /// The drawing as an SVG file; words stay words.
    pub fn svg(&self) -> String {
        let [width, height] = self.size;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        for shape in &self.shapes {
            // Writing to a string cannot fail.
            let _ = match shape {
                Shape::Line {
                    points,
                    width,
                    colour,
                } => {
                    let points: Vec<String> = points
                        .iter()
                        .map(|[x, y]| format!("{x:.1},{y:.1}"))
                        .collect();
                    let (points, ink) = (points.join(" "), hex(*colour));
                    writeln!(
                        text,
                        "<polyline points=\"{points}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"{width}\"/>"
                    )
                }
                Shape::Disc {
                    at: [x, y],
                    radius,
                    colour,
                } => {
                    let ink = hex(*colour);
                    writeln!(
                        text,
                        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{ink}\"/>"
                    )
                }
                Shape::Words {
                    at: [x, y],
                    size,
                    text: words,
                    colour,
                } => {
                    // A font's size is about 1.4 times the height of its capitals, on whose foot the words stand.
                    let (foot, font, ink) = (y + size, 1.4 * size, hex(*colour));
                    writeln!(
                        text,
                        "<text x=\"{x:.1}\" y=\"{foot:.1}\" font-size=\"{font:.1}\" fill=\"{ink}\">{}</text>",
                        escaped(words)
                    )
                }
            };
        }
        text.push_str("</svg>\n");
        text
    }

    /// The drawing as RGBA, rows from the top; words are drawn with strokes.
    pub fn rgba(&self) -> Vec<u8> {
        let [width, height] = self.size.map(|c| c as usize);
        let mut rgba = vec![255; width * height * 4];
        for shape in &self.shapes {
            match shape {
                Shape::Line {
                    points,
                    width: pen,
                    colour,
                } => {
                    for pair in points.windows(2) {
                        let strokes = Strokes::new().line(pair);
                        self.ink(&mut rgba, &strokes, 0.5 * pen, pair, *colour);
                    }
                }
                Shape::Disc { at, radius, colour } => {
                    let strokes = Strokes::new().line(&[*at, [at[0] + 1e-3, at[1]]]);
                    self.ink(&mut rgba, &strokes, *radius, &[*at], *colour);
                }
                Shape::Words {
                    at,
                    size,
                    text,
                    colour,
                } => {
                    // Letter by letter, so that few strokes are asked for each pixel.
                    for (k, letter) in text.chars().enumerate() {
                        let left = [at[0] + ADVANCE * size * k as f64, at[1]];
                        let strokes =
                            Strokes::new().text(letter.encode_utf8(&mut [0; 4]), left, *size);
                        let box_of = [left, [left[0] + size, left[1] + 1.3 * size]];
                        self.ink(&mut rgba, &strokes, 0.07 * size, &box_of, *colour);
                    }
                }
            }
        }
        rgba
    }

    /// Inks what lies within `half` of the strokes, all within the box around `corners`, with a soft edge of one pixel.
    fn ink(
        &self,
        rgba: &mut [u8],
        strokes: &Strokes,
        half: f64,
        corners: &[[f64; 2]],
        colour: Colour,
    ) {
        let reach = half + 1.0;
        let range = |axis: usize| {
            let all = corners.iter().map(|c| c[axis]);
            let low = all.clone().fold(f64::INFINITY, f64::min) - reach;
            let high = all.fold(f64::NEG_INFINITY, f64::max) + reach;
            let most = f64::from(self.size[axis]);
            low.clamp(0.0, most) as usize..high.clamp(0.0, most) as usize
        };
        for row in range(1) {
            for column in range(0) {
                let centre = [column as f64 + 0.5, row as f64 + 0.5];
                let cover = (half + 0.5 - strokes.distance(centre, reach)).clamp(0.0, 1.0);
                let at = (row * self.size[0] as usize + column) * 4;
                if let Some(pixel) = rgba.get_mut(at..at + 3) {
                    for (old, ink) in pixel.iter_mut().zip(colour) {
                        let mixed = f64::from(*old) + cover * (f64::from(ink) - f64::from(*old));
                        *old = mixed.round() as u8;
                    }
                }
            }
        }
    }
}

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_show_the_shapes() {
        let mut drawing = Drawing::new([40, 30]);
        drawing.disc([10.0, 10.0], 4.0, [255, 0, 0]);
        drawing.line(&[[0.0, 25.0], [40.0, 25.0]], 2.0, [0, 0, 255]);
        drawing.words("a<b", [20.0, 5.0], 8.0, [0, 0, 0]);
        let rgba = drawing.rgba();
        let pixel = |x: usize, y: usize| &rgba[(y * 40 + x) * 4..][..3];
        assert_eq!(pixel(10, 10), [255, 0, 0]);
        assert_eq!(pixel(30, 25), [0, 0, 255]);
        assert_eq!(pixel(2, 2), [255, 255, 255]);
        assert!(rgba.chunks(4).any(|p| p[..3].iter().all(|c| *c < 128)));
        let svg = drawing.svg();
        for part in ["<circle", "<polyline", "a&lt;b", "</svg>"] {
            assert!(svg.contains(part), "{part}");
        }
    }
}
