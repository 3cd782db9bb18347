//! The machinery behind the one list of mappings.

/// Declares the mappings in teaching order: `Type in module,`. The module's Rust and WGSL files bear the same name.
macro_rules! registry {
    ($($mapping:ident in $module:ident,)+) => {
        $(pub mod $module;)+

        /// Every mapping, in teaching order.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum MappingId {
            $(#[doc = concat!("See [`", stringify!($module), "`].")] $mapping,)+
        }

        impl MappingId {
            /// Every mapping, in teaching order.
            pub const ALL: &'static [Self] = &[$(Self::$mapping,)+];

            /// What the mapping is called, covers and claims.
            pub fn info(self) -> &'static MappingInfo {
                match self { $(Self::$mapping => &<$module::$mapping as Mapping>::INFO,)+ }
            }

            /// Prefix of the mapping's shader functions: the name of its files.
            pub fn prefix(self) -> &'static str {
                match self { $(Self::$mapping => stringify!($module),)+ }
            }

            /// The mapping's shader source.
            pub fn wgsl(self) -> &'static str {
                match self {
                    $(Self::$mapping => include_str!(concat!(
                        env!("CARGO_MANIFEST_DIR"), "/shaders/mapping/", stringify!($module), ".wgsl"
                    )),)+
                }
            }

            /// See [`Mapping::forward`].
            pub fn forward<R: Real>(self, dir: Vec3<R>) -> Option<ChartPoint<R>> {
                match self { $(Self::$mapping => $module::$mapping::forward(dir),)+ }
            }

            /// See [`Mapping::inverse`].
            pub fn inverse<R: Real>(self, point: ChartPoint<R>) -> Option<Vec3<R>> {
                match self { $(Self::$mapping => $module::$mapping::inverse(point),)+ }
            }

            /// See [`Mapping::continued`].
            pub fn continued<R: Real>(self, point: ChartPoint<R>) -> Vec3<R> {
                match self { $(Self::$mapping => $module::$mapping::continued(point),)+ }
            }

            /// See [`Mapping::FACETS`].
            pub fn facets(self) -> u32 {
                match self { $(Self::$mapping => <$module::$mapping as Mapping>::FACETS,)+ }
            }

            /// See [`Mapping::facet`].
            pub fn facet<R: Real>(self, point: ChartPoint<R>) -> u32 {
                match self { $(Self::$mapping => $module::$mapping::facet(point),)+ }
            }

            /// See [`Mapping::extended`].
            pub fn extended<R: Real>(self, facet: u32, point: ChartPoint<R>) -> Vec3<R> {
                match self { $(Self::$mapping => $module::$mapping::extended(facet, point),)+ }
            }

            /// See [`Mapping::folded`].
            pub fn folded<R: Real>(self, facet: u32, point: ChartPoint<R>) -> Option<ChartPoint<R>> {
                match self { $(Self::$mapping => $module::$mapping::folded(facet, point),)+ }
            }

            /// See [`Mapping::steps`].
            pub fn steps<R: Real + std::fmt::Display>(self, dir: Vec3<R>) -> Vec<Step> {
                match self { $(Self::$mapping => $module::$mapping::steps(dir),)+ }
            }

            /// See [`Mapping::HAS_LANES`].
            pub fn has_lanes(self) -> bool {
                match self { $(Self::$mapping => <$module::$mapping as Mapping>::HAS_LANES,)+ }
            }

            /// See [`Mapping::LANES_HAVE_POLES`].
            pub fn lanes_have_poles(self) -> bool {
                match self { $(Self::$mapping => <$module::$mapping as Mapping>::LANES_HAVE_POLES,)+ }
            }

            /// See [`Mapping::forward_lanes`].
            #[inline(always)]
            pub fn forward_lanes(self, dirs: &DirLanes, points: &mut PointLanes) {
                match self { $(Self::$mapping => $module::$mapping::forward_lanes(dirs, points),)+ }
            }

            /// See [`Mapping::line`].
            pub fn line(self, side: usize, coordinate: f64) -> Line {
                match self { $(Self::$mapping => $module::$mapping::line(side, coordinate),)+ }
            }

            /// See [`Mapping::inverse_lanes`].
            #[inline(always)]
            pub fn inverse_lanes(self, chart: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
                match self { $(Self::$mapping => $module::$mapping::inverse_lanes(chart, columns, row, dirs),)+ }
            }

            /// [`Mapping::forward`] of each direction, computed in another number type and rounded at the end.
            pub(super) fn forward_in<R: Real>(self, dirs: Dirs<'_>, points: PointsMut<'_>) {
                match self { $(Self::$mapping => evaluator::forward_in::<R, $module::$mapping>(dirs, points),)+ }
            }

            /// [`Mapping::inverse`] of each point, computed in another number type and rounded at the end.
            pub(super) fn inverse_in<R: Real>(self, points: Points<'_>, dirs: DirsMut<'_>) {
                match self { $(Self::$mapping => evaluator::inverse_in::<R, $module::$mapping>(points, dirs),)+ }
            }

            /// See [`Mapping::has_meridians`].
            pub fn has_meridians(self, chart: u32) -> bool {
                match self { $(Self::$mapping => $module::$mapping::has_meridians(chart),)+ }
            }

            /// See [`Mapping::latitude_lanes`].
            #[inline(always)]
            pub fn latitude_lanes(self, columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
                match self { $(Self::$mapping => $module::$mapping::latitude_lanes(columns, row, latitudes),)+ }
            }

            /// See [`Mapping::PARALLELS`].
            pub fn parallels(self) -> Option<[f32; 2]> {
                match self { $(Self::$mapping => <$module::$mapping as Mapping>::PARALLELS,)+ }
            }

            /// See [`Mapping::HAS_FACES`].
            pub fn has_faces(self) -> bool {
                match self { $(Self::$mapping => <$module::$mapping as Mapping>::HAS_FACES,)+ }
            }

            /// See [`cube_face::graticule_lanes`]; nothing where the mapping has no faces.
            #[inline(always)]
            pub fn graticule_lanes(
                self,
                meridians: (&[u32; LANES], [&Lane; 4]),
                parallel: Line,
                points: &mut PointLanes,
            ) {
                match self {
                    $(Self::$mapping => if <$module::$mapping as Mapping>::HAS_FACES {
                        cube_face::graticule_lanes(meridians, parallel, points, $module::$mapping::from_middle);
                    },)+
                }
            }

        }
    };
}
