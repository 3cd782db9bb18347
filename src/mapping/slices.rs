//! Many directions and chart points, component by component: what evaluators read and write.

use std::ops::Range;

use super::ChartPoint;
use crate::math::Vec3;

/// Stands for no chart, where a direction has none.
pub const NOWHERE: u32 = u32::MAX;

macro_rules! slices {
    ($view:ident, $view_mut:ident, $list:ident, $what:literal, $($name:ident: $type:ty),+) => {
        #[doc = concat!("Borrowed ", $what, ".")]
        #[derive(Clone, Copy, Debug)]
        pub struct $view<'a> {
            $(#[allow(missing_docs, reason = "a component")] pub $name: &'a [$type],)+
        }

        #[doc = concat!("Room for ", $what, ".")]
        #[derive(Debug)]
        pub struct $view_mut<'a> {
            $(#[allow(missing_docs, reason = "a component")] pub $name: &'a mut [$type],)+
        }

        #[doc = concat!("A list of ", $what, ".")]
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $list {
            $(#[allow(missing_docs, reason = "a component")] pub $name: Vec<$type>,)+
        }

        impl $view<'_> {
            /// How many all components have.
            pub fn len(&self) -> usize {
                usize::MAX$(.min(self.$name.len()))+
            }

            /// True when there are none.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Those of a range; fewer where it goes on beyond the end.
            pub fn part(&self, range: Range<usize>) -> Self {
                let end = range.end.min(self.len());
                let range = range.start.min(end)..end;
                Self { $($name: &self.$name[range.clone()],)+ }
            }
        }

        impl $view_mut<'_> {
            /// How many fit.
            pub fn len(&self) -> usize {
                usize::MAX$(.min(self.$name.len()))+
            }

            /// True when there is no room.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// The first `at` and the others.
            pub fn split_at(self, at: usize) -> (Self, Self) {
                let at = at.min(self.len());
                $(let $name = self.$name.split_at_mut(at);)+
                (Self { $($name: $name.0,)+ }, Self { $($name: $name.1,)+ })
            }
        }

        impl $list {
            /// Zeros.
            pub fn zeros(count: usize) -> Self {
                Self { $($name: vec![Default::default(); count],)+ }
            }

            /// How many there are.
            pub fn len(&self) -> usize {
                self.view().len()
            }

            /// True when there are none.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// All of them.
            pub fn view(&self) -> $view<'_> {
                $view { $($name: &self.$name,)+ }
            }

            /// All of them, to be written.
            pub fn view_mut(&mut self) -> $view_mut<'_> {
                $view_mut { $($name: &mut self.$name,)+ }
            }
        }
    };
}
slices!(Dirs, DirsMut, DirList, "directions, of any length", x: f32, y: f32, z: f32);
slices!(Points, PointsMut, PointList, "chart points; [`NOWHERE`] for none", chart: u32, u: f32, v: f32);

impl Dirs<'_> {
    /// The direction at an index below [`Self::len`].
    #[inline(always)]
    pub fn at(&self, index: usize) -> Vec3<f32> {
        Vec3::new(self.x[index], self.y[index], self.z[index])
    }

    /// The same, `None` where the zero vector stands for none.
    pub fn get(&self, index: usize) -> Option<Vec3<f32>> {
        Some(self.at(index)).filter(|dir| dir.max_abs() > 0.0)
    }
}

impl DirsMut<'_> {
    /// Writes a direction, or the zero vector for none, at an index below [`Self::len`].
    #[inline(always)]
    pub fn set(&mut self, index: usize, dir: Option<[f32; 3]>) {
        let [x, y, z] = dir.unwrap_or([0.0; 3]);
        (self.x[index], self.y[index], self.z[index]) = (x, y, z);
    }
}

impl Points<'_> {
    /// The point at an index below [`Self::len`].
    #[inline(always)]
    pub fn at(&self, index: usize) -> ChartPoint<f32> {
        ChartPoint::new(self.chart[index], self.u[index], self.v[index])
    }

    /// The same, `None` where [`NOWHERE`] stands for none.
    pub fn get(&self, index: usize) -> Option<ChartPoint<f32>> {
        Some(self.at(index)).filter(|point| point.chart != NOWHERE)
    }
}

impl PointsMut<'_> {
    /// Writes a point, or [`NOWHERE`] for none, at an index below [`Self::len`].
    #[inline(always)]
    pub fn set(&mut self, index: usize, point: Option<ChartPoint<f32>>) {
        let point = point.unwrap_or(ChartPoint::new(NOWHERE, 0.0, 0.0));
        (self.chart[index], self.u[index], self.v[index]) = (point.chart, point.u, point.v);
    }
}

impl FromIterator<[f32; 3]> for DirList {
    fn from_iter<I: IntoIterator<Item = [f32; 3]>>(dirs: I) -> Self {
        let mut list = Self::default();
        for [x, y, z] in dirs {
            list.x.push(x);
            list.y.push(y);
            list.z.push(z);
        }
        list
    }
}

impl FromIterator<ChartPoint<f32>> for PointList {
    fn from_iter<I: IntoIterator<Item = ChartPoint<f32>>>(points: I) -> Self {
        let mut list = Self::default();
        for point in points {
            list.chart.push(point.chart);
            list.u.push(point.u);
            list.v.push(point.v);
        }
        list
    }
}
