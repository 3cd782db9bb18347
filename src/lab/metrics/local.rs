//! How a mapping distorts around one point: the axes of Tissot's indicatrix in units that can be compared.

use std::f64::consts::FRAC_PI_4;

use crate::mapping::{ChartPoint, Domain, Jacobian, MappingId};

/// What a mapping's points are compared with.
#[derive(Clone, Copy, Debug)]
pub struct Yardstick {
    map: MappingId,
    /// Mean solid angle per unit of chart area in the domain, sr.
    mean_sr: f64,
    /// Side of the square, in radians, that each unit of chart area had if all texels, those beside a disc too, were spread evenly over what is covered.
    ideal_rad: f64,
}

/// The distortion at a point. Texels are as square as the chart's aspect makes them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// Solid angle of a texel over the mean one.
    pub area: f64,
    /// Larger over smaller axis of Tissot's indicatrix (Lambers's D_I): at least 1, infinite where a texel collapses.
    pub anisotropy: f64,
    /// Longest extent of a texel over the side of the ideal one, where as many squares cover the same solid angle.
    pub linear: f64,
    /// Lengths of a texel's sides along u and v over the ideal side.
    pub sides: [f64; 2],
    /// Lengths of a texel's diagonals over the ideal side.
    pub diagonals: [f64; 2],
}

impl Local {
    /// Largest angle by which an angle can differ on the map, in radians.
    pub fn omega_rad(&self) -> f64 {
        omega_rad(self.anisotropy)
    }
}

/// Largest error of an angle where the axes have this ratio, in radians: 2 asin((a - b)/(a + b)), here by its tangent, which keeps
/// its digits where a and b are alike.
pub fn omega_rad(anisotropy: f64) -> f64 {
    if anisotropy.is_infinite() {
        return std::f64::consts::PI;
    }
    2.0 * f64::atan2(anisotropy - 1.0, 2.0 * anisotropy.sqrt())
}

impl Yardstick {
    /// That of a mapping.
    pub fn new(map: MappingId) -> Self {
        let info = map.info();
        let domain = match info.domain {
            Domain::Square => 1.0,
            Domain::Disc => FRAC_PI_4,
        };
        let chart_sr = info.coverage.solid_angle_sr() / f64::from(info.chart_count());
        Self {
            map,
            mean_sr: chart_sr / domain,
            ideal_rad: chart_sr.sqrt(),
        }
    }

    /// Area of a chart's domain, over that of the chart.
    pub fn domain(&self) -> f64 {
        self.ideal_rad * self.ideal_rad / self.mean_sr
    }

    /// The distortion at a point; `None` off the chart, and where no number is found.
    pub fn at(&self, point: ChartPoint<f64>) -> Option<Local> {
        let (_, jacobian) = self.map.jacobian(point)?;
        let local = self.of(&jacobian.of_square_texels(self.map.info().aspect));
        (local.area.is_finite() && !local.anisotropy.is_nan()).then_some(local)
    }

    fn of(&self, jacobian: &Jacobian<f64>) -> Local {
        let Jacobian { du, dv } = *jacobian;
        let (large, _) = jacobian.singular_values();
        let area = jacobian.area_scale();
        Local {
            area: area / self.mean_sr,
            // Not `large / small`, which is 0/0 where both are.
            anisotropy: large * large / area,
            linear: large / self.ideal_rad,
            sides: [du, dv].map(|side| side.length() / self.ideal_rad),
            diagonals: [du + dv, du - dv].map(|diagonal| diagonal.length() / self.ideal_rad),
        }
    }
}

/// What is shown of a map's distortion, as a picture or an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Solid angle of a texel over the mean one.
    Area,
    /// Ratio of the axes of Tissot's indicatrix.
    Shape,
    /// Longest extent of a texel over the side of the ideal one.
    Linear,
    /// Texels per square degree.
    Density,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Area, Self::Shape, Self::Linear, Self::Density];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area of a texel",
            Self::Shape => "shape: a/b",
            Self::Linear => "longest extent of a texel",
            Self::Density => "texels per square degree",
        }
    }

    /// What 1 is, for a legend.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Area => "× the mean",
            Self::Shape => "",
            Self::Linear => "× the ideal square's side",
            Self::Density => "",
        }
    }

    /// Its value at a point of a map of `texels` texels in all.
    pub fn of(self, local: &Local, yardstick: &Yardstick, texels: f64) -> f64 {
        match self {
            Self::Area => local.area,
            Self::Shape => local.anisotropy,
            Self::Linear => local.linear,
            Self::Density => even_density(yardstick, texels) / (local.area / yardstick.domain()),
        }
    }

    /// Both ends of its scale, the same for every mapping so that pictures can be compared; the scale is logarithmic.
    pub fn scale(self, texels: f64) -> [f64; 2] {
        match self {
            // From a quarter to four times: the cube map reaches from 0.37 to 1.9, the paraboloid has a ratio of 4.
            Self::Area => [0.25, 4.0],
            Self::Shape => [1.0, 4.0],
            Self::Linear => [0.5, 4.0],
            // The same around even texels over the whole sphere.
            Self::Density => [0.25, 4.0].map(|c| c * texels / SPHERE_DEG2),
        }
    }

    /// Where a value stands on the scale, 0 to 1.
    pub fn place(self, value: f64, texels: f64) -> f64 {
        let [low, high] = self.scale(texels).map(f64::ln);
        ((value.ln() - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// The value at a place of the scale.
    pub fn value(self, place: f64, texels: f64) -> f64 {
        let [low, high] = self.scale(texels).map(f64::ln);
        (low + place * (high - low)).exp()
    }
}

/// Square degrees of the whole sphere: 4 pi (180/pi)^2.
const SPHERE_DEG2: f64 = 129_600.0 / std::f64::consts::PI;

/// Texels per square degree if they were spread evenly over what a mapping covers.
fn even_density(yardstick: &Yardstick, texels: f64) -> f64 {
    let covered = yardstick.map.info().coverage.solid_angle_sr() / (4.0 * std::f64::consts::PI);
    texels / (covered * SPHERE_DEG2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(map: MappingId, u: f64, v: f64) -> Local {
        Yardstick::new(map).at(ChartPoint::new(0, u, v)).unwrap()
    }

    #[test]
    fn known_points_have_known_distortions() {
        // The middle of a cube's face: solid angle 4 where the mean is 4 pi/6.
        let middle = at(MappingId::Cube, 0.5, 0.5);
        let mean = 4.0 * std::f64::consts::PI / 6.0;
        assert!((middle.area - 4.0 / mean).abs() < 1e-14);
        assert!((middle.linear - (4.0 / mean).sqrt()).abs() < 1e-14);
        assert!((middle.anisotropy - 1.0).abs() < 1e-7 && middle.omega_rad() < 1e-7);
        // Its corner: a/b = sqrt 3, a right angle is one of 120 degrees there: 2 asin((a - b)/(a + b)).
        let corner = at(MappingId::Cube, 1e-12, 1e-12);
        assert!((corner.anisotropy - 3f64.sqrt()).abs() < 1e-9);
        let root = 3f64.sqrt();
        let omega = 2.0 * ((root - 1.0) / (root + 1.0)).asin();
        assert!((corner.omega_rad() - omega).abs() < 1e-9);
        // A latlong's equator has square texels, 60 degrees north they are twice as high as wide.
        assert!((at(MappingId::Latlong, 0.3, 0.5).anisotropy - 1.0).abs() < 1e-7);
        let north = at(MappingId::Latlong, 0.3, 1.0 / 6.0);
        assert!((north.anisotropy - 2.0).abs() < 1e-12);
        assert!((north.sides[1] / north.sides[0] - 2.0).abs() < 1e-12);
        // A disc's mean is that of its texels; its ideal counts those beside it too.
        let sphere = at(MappingId::Sphere, 0.6, 0.7);
        assert!((sphere.area - 1.0).abs() < 1e-12);
        let yardstick = Yardstick::new(MappingId::Sphere);
        let density = Quantity::Density.of(&sphere, &yardstick, SPHERE_DEG2);
        assert!((density - FRAC_PI_4).abs() < 1e-12, "{density}");
    }

    #[test]
    fn a_place_of_the_scale_and_its_value_belong_together() {
        for quantity in Quantity::ALL {
            for place in [0.0, 0.3, 1.0] {
                let value = quantity.value(place, 5e5);
                assert!((quantity.place(value, 5e5) - place).abs() < 1e-12);
            }
            assert_eq!(quantity.place(1e9, 5e5), 1.0);
            assert_eq!(quantity.place(f64::INFINITY, 5e5), 1.0);
            assert_eq!(quantity.place(0.0, 5e5), 0.0);
        }
    }
}
