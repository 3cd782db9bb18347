//! What the laws look at: a mapping, or a stand-in that is broken on purpose.

use sixfold::mapping::{ChartPoint, Domain, Jacobian, MappingId, MappingInfo};
use sixfold::math::{Real, Vec3};

/// A way to be wrong. Each law names those that it must notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// u and v exchanged.
    SwapUv,
    /// Left and right exchanged.
    Mirror,
    /// u and v kept to 14 bits, about what an inverse sine of a software driver leaves.
    Coarse,
    /// The latitude from acos(y), which loses half the digits at the poles (latlong only).
    AcosLatitude,
    /// The inverse is a thousandth too long.
    Long,
    /// The inverse leans to +x by a thousandth.
    Tilted,
    /// The chart is a thousandth too large for its square.
    Stretched,
    /// The index of the next chart.
    NextChart,
    /// On ties x wins.
    TiesToX,
    /// Directions around (-1, -1, 0) have no chart, as in the printed shader.
    Hole,
    /// Everything that is no direction or off the chart has an image.
    Careless,
    /// Squares overflow and underflow.
    Unscaled,
    /// One column of the Jacobian is wrong by up to a hundredth.
    Skewed,
    /// The Jacobian of a flat sheet.
    Flat,
    /// One chart, or half of it, is divided differently.
    OneSided,
    /// The plain cube map stands in.
    PlainCube,
    /// The continued inverse is a millionth of a chart beside the inverse.
    Shifted,
    /// Beyond the border it leans by a hundredth.
    Jumping,
    /// Beyond the border it repeats the border.
    Clamped,
}

/// A mapping, perhaps broken, and how many inputs to spend on it.
#[derive(Clone, Copy, Debug)]
pub struct Subject {
    pub map: MappingId,
    pub fault: Option<Fault>,
    /// Number of random inputs for a law that is quick; the others take a share of it.
    pub effort: usize,
}

impl Subject {
    pub fn info(&self) -> &'static MappingInfo {
        self.map.info()
    }

    pub fn is(&self, fault: Fault) -> bool {
        self.fault == Some(fault)
    }

    pub fn forward<R: Real>(&self, dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let Some(fault) = self.fault else {
            return self.map.forward(dir);
        };
        let Some(mut p) = self.map.forward(self.broken_dir(dir)) else {
            let centre = ChartPoint::new(0, R::half(), R::half());
            return (fault == Fault::Careless).then_some(centre);
        };
        let number = R::from_f64;
        match fault {
            Fault::SwapUv => p = ChartPoint::new(p.chart, p.v, p.u),
            Fault::NextChart => p.chart += 1,
            Fault::Hole if near_a_hole(dir.to_f64()) => return None,
            Fault::Stretched => {
                let stretch = |c: R| R::half() + (c - R::half()) * number(1.001);
                p = ChartPoint::new(p.chart, stretch(p.u), stretch(p.v));
            }
            Fault::Coarse => {
                let coarse = |c: R| number((c.to_f64() * 16384.0).round() / 16384.0);
                p = ChartPoint::new(p.chart, coarse(p.u), coarse(p.v));
            }
            Fault::AcosLatitude => {
                let cosine = (dir.y / dir.length()).min(R::one()).max(-R::one());
                let angle = cosine.to_f64().acos();
                p.v = number(angle * std::f64::consts::FRAC_1_PI);
            }
            Fault::PlainCube => return MappingId::Cube.forward(dir),
            Fault::OneSided if p.chart == 0 && p.u <= R::half() => {
                p.v = p.v + number(0.01) * p.v * (R::one() - p.v);
            }
            _ => {}
        }
        Some(p)
    }

    fn broken_dir<R: Real>(&self, dir: Vec3<R>) -> Vec3<R> {
        match self.fault {
            Some(Fault::Mirror) => Vec3::new(-dir.x, dir.y, dir.z),
            Some(Fault::TiesToX) => {
                let larger = R::from_f64(1.0 + R::EPSILON);
                Vec3::new(dir.x * larger, dir.y, dir.z)
            }
            Some(Fault::Unscaled) => {
                let squared = |c: R| {
                    let square = c * c;
                    if square > R::zero() {
                        square / c
                    } else {
                        square
                    }
                };
                Vec3::new(squared(dir.x), squared(dir.y), squared(dir.z))
            }
            _ => dir,
        }
    }

    pub fn inverse<R: Real>(&self, point: ChartPoint<R>) -> Option<Vec3<R>> {
        let dir = self.map.inverse(point);
        match self.fault {
            Some(Fault::Careless) if dir.is_none() => Some(Vec3::from_f64([0.0, 0.0, 1.0])),
            Some(Fault::Tilted) => dir.map(|d| d + Vec3::from_f64([1e-3, 0.0, 0.0])),
            Some(Fault::Long) => dir.map(|d| d * R::from_f64(1.001)),
            _ => dir,
        }
    }

    pub fn continued<R: Real>(&self, point: ChartPoint<R>) -> Vec3<R> {
        let number = R::from_f64;
        let info = self.info();
        let is_beyond =
            !(point.is_on(info.chart_count()) && info.domain.contains(point.u, point.v));
        match self.fault {
            Some(Fault::Shifted) => {
                let shifted = ChartPoint::new(point.chart, point.u + number(1e-6), point.v);
                self.map.continued(shifted)
            }
            Some(Fault::Long) => self.map.continued(point) * number(1.001),
            Some(Fault::Jumping) if is_beyond => {
                let lean = Vec3::from_f64([0.006, 0.007, 0.005]);
                (self.map.continued(point) + lean).normalized()
            }
            Some(Fault::Clamped) if is_beyond => self.map.continued(self.on_chart(point)),
            _ => self.map.continued(point),
        }
    }

    /// The nearest point of the chart.
    fn on_chart<R: Real>(&self, point: ChartPoint<R>) -> ChartPoint<R> {
        if self.info().domain == Domain::Square {
            return point.clamped();
        }
        let (p, q) = (point.u - R::half(), point.v - R::half());
        let shrink = R::half() / p.hypot(q).max(R::half());
        ChartPoint::new(point.chart, R::half() + p * shrink, R::half() + q * shrink)
    }

    /// The sound mapping's inverse in f64. A rim point rounded to f32 may lie outside of the disc by more than f64 allows:
    /// it stands for the nearest point of the rim.
    pub fn exact_inverse(&self, point: ChartPoint<f64>) -> Option<[f64; 3]> {
        self.map.inverse(self.on_disc(point)).map(Vec3::to_f64)
    }

    fn on_disc(&self, point: ChartPoint<f64>) -> ChartPoint<f64> {
        let (p, q) = (point.u - 0.5, point.v - 0.5);
        let beyond = 2.0 * p.hypot(q);
        let slack = 1.0 + 4.0 * f64::from(f32::EPSILON);
        if self.info().domain == Domain::Square || beyond <= 1.0 || beyond > slack {
            return point;
        }
        ChartPoint::new(point.chart, 0.5 + p / beyond, 0.5 + q / beyond)
    }

    pub fn jacobian(&self, point: ChartPoint<f64>) -> Option<Jacobian<f64>> {
        let (_, mut jacobian) = self.map.jacobian(self.on_disc(point))?;
        if self.is(Fault::Flat) {
            jacobian.du = Vec3::from_f64([1.0, 0.0, 0.0]);
            jacobian.dv = Vec3::from_f64([0.0, 1.0, 0.0]);
        }
        if self.is(Fault::Skewed) {
            jacobian.du = jacobian.du * (1.0 + 0.01 * point.u);
        }
        Some(jacobian)
    }

    /// Largest error that f32 keeps outside of the weak spots, where there are any.
    pub fn weak_budget(&self) -> Option<f64> {
        let spots = self.info().weak_spots.iter();
        spots.map(|spot| spot.outside_rad).reduce(f64::max)
    }

    pub fn is_weak(&self, dir: [f64; 3]) -> bool {
        self.info().weak_spots.iter().any(|spot| spot.contains(dir))
    }
}

fn near_a_hole([x, y, z]: [f64; 3]) -> bool {
    x < 0.0 && (x - y).abs() < -3e-4 * x && z.abs() < -3e-4 * x
}
