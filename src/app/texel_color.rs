//! The probed texel's colour, read back from the device without waiting for it.

use crate::gpu::{Renderer, TexelRead};
use crate::mapping::MappingId;

/// Which texel of which drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelKey {
    /// The map.
    pub mapping: MappingId,
    /// Its chart.
    pub chart: u32,
    /// Column and row.
    pub texel: [u32; 2],
    /// Maps drawn so far: after another one the colour may be another.
    pub bakes: u64,
}

/// The last colour that came back, and the one that is on its way.
#[derive(Default)]
pub struct TexelColor {
    /// `None` as colour after a fault: it is not asked for again.
    known: Option<(TexelKey, Option<[f32; 3]>)>,
    coming: Option<(TexelKey, TexelRead)>,
}

impl TexelColor {
    /// Linear colour of the texel, or `None` while it is on its way.
    pub fn get(&mut self, renderer: &Renderer, key: TexelKey) -> Option<[f32; 3]> {
        if let Some((wanted, read)) = &self.coming
            && let Some(answer) = read.poll()
        {
            // After a fault the texel shows as unknown; the renderer reports the fault itself.
            self.known = Some((*wanted, answer.ok()));
            self.coming = None;
        }
        match self.known {
            Some((known, color)) if known == key => color,
            _ => {
                if self.coming.is_none() {
                    let read = renderer
                        .begin_read_texel(key.mapping, key.chart, key.texel)
                        .ok();
                    self.coming = read.map(|read| (key, read));
                }
                None
            }
        }
    }

    /// A colour is on its way: look again soon.
    pub fn is_waiting(&self) -> bool {
        self.coming.is_some()
    }
}
