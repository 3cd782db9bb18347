//! The kinds of mappings, under which lists group them.

use serde::{Deserialize, Serialize};

use super::MappingId;

/// What kind of picture a mapping makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Columns are meridians and rows parallels.
    Graticule,
    /// One round picture or two.
    Discs,
    /// Six squares, each divided in its own way.
    Cubes,
    /// Eight triangles, folded out into one square.
    Octahedra,
    /// Squares that are neither a cube's nor an octahedron's, with the same solid angle in every texel.
    EqualPixels,
}

impl Family {
    /// All of them, in the order in which they are taught: by their first mapping.
    pub const ALL: [Self; 5] = [
        Self::Graticule,
        Self::Discs,
        Self::Cubes,
        Self::Octahedra,
        Self::EqualPixels,
    ];

    /// Its heading.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Graticule => "Latitude and longitude",
            Self::Discs => "Discs",
            Self::Cubes => "The cube family",
            Self::Octahedra => "Octahedra",
            Self::EqualPixels => "Equal pixels",
        }
    }

    /// Its mappings, in teaching order.
    pub fn mappings(self) -> impl Iterator<Item = MappingId> {
        let all = MappingId::ALL.iter().copied();
        all.filter(move |map| map.info().family == self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mapping_stands_under_one_heading_and_no_heading_is_empty() {
        let grouped: Vec<MappingId> = Family::ALL.into_iter().flat_map(Family::mappings).collect();
        assert_eq!(grouped.len(), MappingId::ALL.len());
        let mut firsts = Vec::new();
        for family in Family::ALL {
            let first = family.mappings().next().unwrap();
            firsts.push(MappingId::ALL.iter().position(|map| *map == first));
        }
        assert!(firsts.is_sorted(), "{firsts:?}");
    }
}
