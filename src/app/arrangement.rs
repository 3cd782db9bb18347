//! The arrangement of the panes as plain data: what a saved scene holds of the tiles, whatever library shows them.

use std::collections::HashSet;

use egui_tiles::{Container, Grid, GridLayout, Linear, LinearDir, Tabs, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

use crate::mapping::MappingId;

/// What a tile shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pane {
    /// The mirror object before its surroundings.
    Viewport,
    /// The unfolded picture of a mapping.
    Map(MappingId),
    /// Reflectance over the angle of incidence.
    Curves,
    /// The ray story.
    Story,
    /// What a conversion loses.
    Loss,
    /// Where the ways to compute a mapping break.
    Stability,
    /// Two mappings with as many texels.
    Budget,
    /// Run time against error.
    Laboratory,
    /// The map between the flat picture and the sphere.
    Fold,
    /// All mappings in the order of a criterion.
    Ranking,
    /// How evenly two mappings part the horizon.
    Sampling,
}

impl Pane {
    /// The panes that are read more than looked at: the window's menu lists them, and they need height.
    pub const READ: [Self; 9] = [
        Self::Curves,
        Self::Story,
        Self::Loss,
        Self::Laboratory,
        Self::Stability,
        Self::Fold,
        Self::Budget,
        Self::Ranking,
        Self::Sampling,
    ];

    /// Its title.
    pub fn name(self) -> &'static str {
        match self {
            Self::Viewport => "Viewport",
            Self::Map(mapping) => mapping.info().name,
            Self::Curves => "Reflectance curves",
            Self::Story => "Ray story",
            Self::Loss => "Loss laboratory",
            Self::Stability => "Stability",
            Self::Budget => "Equal texel budget",
            Self::Laboratory => "Run time and error",
            Self::Fold => "Fold and unfold",
            Self::Ranking => "Which mapping is best?",
            Self::Sampling => "Sampling of the horizon",
        }
    }
}

/// Panes in tabs, rows, columns and grids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// One pane.
    Pane(Pane),
    /// One above the other, of which one is seen.
    Tabs {
        /// Index of the one that is seen.
        active: usize,
        /// What is under the tabs.
        children: Vec<Self>,
    },
    /// Side by side.
    Row(Vec<Share>),
    /// One below the other.
    Column(Vec<Share>),
    /// In rows and columns.
    Grid {
        /// Number of columns; `None` lets the window's shape decide.
        columns: Option<usize>,
        /// What is in the cells, row by row.
        children: Vec<Self>,
    },
}

/// A part of a row or column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// Its size in relation to its neighbours.
    pub share: f32,
    /// What is there.
    pub content: Arrangement,
}

/// Shares from a file are kept within these bounds, so that every part can be seen and grabbed.
const SHARES: (f32, f32) = (0.02, 50.0);

impl Arrangement {
    /// What the tiles show; `None` when they show nothing.
    pub fn of_tree(tree: &Tree<Pane>) -> Option<Self> {
        Self::of_tile(&tree.tiles, tree.root()?)
    }

    fn of_tile(tiles: &Tiles<Pane>, id: TileId) -> Option<Self> {
        let all = |ids: &[TileId]| {
            ids.iter()
                .filter_map(|id| Self::of_tile(tiles, *id))
                .collect()
        };
        Some(match tiles.get(id)? {
            Tile::Pane(pane) => Self::Pane(*pane),
            Tile::Container(Container::Tabs(tabs)) => {
                let active = tabs
                    .children
                    .iter()
                    .position(|child| Some(*child) == tabs.active);
                Self::Tabs {
                    active: active.unwrap_or(0),
                    children: all(&tabs.children),
                }
            }
            Tile::Container(Container::Linear(linear)) => {
                let share_of = |id: TileId| {
                    let found = linear.shares.iter().find(|(child, _)| **child == id);
                    found.map_or(1.0, |(_, share)| *share)
                };
                let parts = linear.children.iter().filter_map(|id| {
                    let content = Self::of_tile(tiles, *id)?;
                    Some(Share {
                        share: share_of(*id),
                        content,
                    })
                });
                match linear.dir {
                    LinearDir::Horizontal => Self::Row(parts.collect()),
                    LinearDir::Vertical => Self::Column(parts.collect()),
                }
            }
            Tile::Container(Container::Grid(grid)) => Self::Grid {
                columns: match grid.layout {
                    GridLayout::Columns(columns) => Some(columns),
                    GridLayout::Auto => None,
                },
                children: all(&grid.children().copied().collect::<Vec<_>>()),
            },
        })
    }

    /// The tiles that show this. A pane that stands twice is shown once, and what is empty is left out; `None` when nothing
    /// is left.
    pub fn to_tree(&self, id: egui::Id) -> Option<Tree<Pane>> {
        let mut tiles = Tiles::default();
        let root = self.insert(&mut tiles, &mut HashSet::new())?;
        Some(Tree::new(id, root, tiles))
    }

    /// True when the pane is somewhere in it.
    pub fn holds(&self, pane: Pane) -> bool {
        match self {
            Self::Pane(held) => *held == pane,
            Self::Tabs { children, .. } | Self::Grid { children, .. } => {
                children.iter().any(|child| child.holds(pane))
            }
            Self::Row(parts) | Self::Column(parts) => parts.iter().any(|p| p.content.holds(pane)),
        }
    }

    /// The same with `pane` as a column at the right of all, a little more than half as wide as the rest.
    pub fn with_column(self, pane: Pane) -> Self {
        let part = |share, content| Share { share, content };
        Self::Row(vec![part(1.6, self), part(0.9, Self::Pane(pane))])
    }

    /// The same with `pane` put below `neighbour`, wherever that is; tabs stay together.
    pub fn with_below(self, neighbour: Pane, pane: Pane) -> Self {
        let below = |held: Self| {
            let part = |content| Share {
                share: 1.0,
                content,
            };
            Self::Column(vec![part(held), part(Self::Pane(pane))])
        };
        let parts = |parts: Vec<Share>| -> Vec<Share> {
            let part = |part: Share| Share {
                content: part.content.with_below(neighbour, pane),
                ..part
            };
            parts.into_iter().map(part).collect()
        };
        match self {
            Self::Pane(held) if held == neighbour => below(self),
            Self::Tabs { .. } if self.holds(neighbour) => below(self),
            Self::Pane(_) | Self::Tabs { .. } => self,
            Self::Row(held) => Self::Row(parts(held)),
            Self::Column(held) => Self::Column(parts(held)),
            Self::Grid { columns, children } => Self::Grid {
                columns,
                children: children
                    .into_iter()
                    .map(|child| child.with_below(neighbour, pane))
                    .collect(),
            },
        }
    }

    fn insert(&self, tiles: &mut Tiles<Pane>, seen: &mut HashSet<Pane>) -> Option<TileId> {
        match self {
            Self::Pane(pane) => seen.insert(*pane).then(|| tiles.insert_pane(*pane)),
            Self::Tabs { active, children } => {
                let ids = insert_all(children, tiles, seen)?;
                let mut tabs = Tabs::new(ids.clone());
                tabs.active = ids.get(*active).or(ids.first()).copied();
                Some(tiles.insert_new(Tile::Container(Container::Tabs(tabs))))
            }
            Self::Row(parts) => insert_linear(LinearDir::Horizontal, parts, tiles, seen),
            Self::Column(parts) => insert_linear(LinearDir::Vertical, parts, tiles, seen),
            Self::Grid { columns, children } => {
                let ids = insert_all(children, tiles, seen)?;
                let most = ids.len();
                let mut grid = Grid::new(ids);
                if let Some(columns) = columns {
                    grid.layout = GridLayout::Columns((*columns).clamp(1, most));
                }
                Some(tiles.insert_new(Tile::Container(Container::Grid(grid))))
            }
        }
    }
}

fn insert_all(
    children: &[Arrangement],
    tiles: &mut Tiles<Pane>,
    seen: &mut HashSet<Pane>,
) -> Option<Vec<TileId>> {
    let ids: Vec<TileId> = children
        .iter()
        .filter_map(|c| c.insert(tiles, seen))
        .collect();
    (!ids.is_empty()).then_some(ids)
}

fn insert_linear(
    dir: LinearDir,
    parts: &[Share],
    tiles: &mut Tiles<Pane>,
    seen: &mut HashSet<Pane>,
) -> Option<TileId> {
    let mut linear = Linear::new(dir, Vec::new());
    for part in parts {
        let Some(id) = part.content.insert(tiles, seen) else {
            continue;
        };
        let share = if part.share.is_finite() {
            part.share
        } else {
            1.0
        };
        linear.add_child(id);
        linear.shares.set_share(id, share.clamp(SHARES.0, SHARES.1));
    }
    let is_empty = linear.children.is_empty();
    (!is_empty).then(|| tiles.insert_new(Tile::Container(Container::Linear(linear))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn id() -> egui::Id {
        egui::Id::unique("test")
    }

    fn pane(mapping: MappingId) -> Arrangement {
        Arrangement::Pane(Pane::Map(mapping))
    }

    #[test]
    fn tiles_survive_their_file() {
        let arrangement = Arrangement::Column(vec![
            Share {
                share: 2.0,
                content: Arrangement::Pane(Pane::Viewport),
            },
            Share {
                share: 1.0,
                content: Arrangement::Grid {
                    columns: Some(2),
                    children: vec![
                        pane(MappingId::Ccm),
                        Arrangement::Tabs {
                            active: 1,
                            children: vec![pane(MappingId::Cube), pane(MappingId::Eac)],
                        },
                    ],
                },
            },
        ]);
        let text = serde_json::to_string(&arrangement).unwrap();
        let read: Arrangement = serde_json::from_str(&text).unwrap();
        assert_eq!(
            Arrangement::of_tree(&read.to_tree(id()).unwrap()),
            Some(arrangement)
        );
    }

    #[test]
    fn a_pane_is_put_beside_all_and_another_below_it() {
        let two = Arrangement::Column(vec![
            Share {
                share: 2.0,
                content: Arrangement::Pane(Pane::Viewport),
            },
            Share {
                share: 1.0,
                content: pane(MappingId::Ccm),
            },
        ]);
        assert!(!two.holds(Pane::Story));
        let three = two.clone().with_column(Pane::Story);
        assert!(three.holds(Pane::Story) && !three.holds(Pane::Curves));
        let Arrangement::Row(row) = three.with_below(Pane::Story, Pane::Curves) else {
            panic!("the story is no column of its own")
        };
        assert_eq!(row[0].content, two);
        let Arrangement::Column(column) = &row[1].content else {
            panic!("the curves are not below the story")
        };
        assert_eq!(column[0].content, Arrangement::Pane(Pane::Story));
        assert_eq!(column[1].content, Arrangement::Pane(Pane::Curves));
    }

    #[test]
    fn hostile_numbers_and_doubles_are_mended() {
        let twice = Arrangement::Row(vec![
            Share {
                share: f32::NAN,
                content: pane(MappingId::Ccm),
            },
            Share {
                share: -1e30,
                content: pane(MappingId::Ccm),
            },
            Share {
                share: f32::INFINITY,
                content: pane(MappingId::Cube),
            },
        ]);
        let mended = Arrangement::of_tree(&twice.to_tree(id()).unwrap()).unwrap();
        assert_eq!(
            mended,
            Arrangement::Row(vec![
                Share {
                    share: 1.0,
                    content: pane(MappingId::Ccm)
                },
                Share {
                    share: 1.0,
                    content: pane(MappingId::Cube)
                },
            ])
        );
        let wide = Arrangement::Grid {
            columns: Some(usize::MAX),
            children: vec![pane(MappingId::Eac)],
        };
        let Some(Arrangement::Grid {
            columns: Some(1), ..
        }) = Arrangement::of_tree(&wide.to_tree(id()).unwrap())
        else {
            panic!("a grid wider than its content")
        };
        assert!(Arrangement::Row(Vec::new()).to_tree(id()).is_none());
    }
}
