//! Glasses and metals against published figures, and the colours of wavelengths.

use sixfold::optics::glass::{FRAUNHOFER_C_UM, FRAUNHOFER_D_UM, FRAUNHOFER_F_UM, Glass};
use sixfold::optics::material::{Dispersion, Surface};
use sixfold::optics::metal::Metal;
use sixfold::optics::reflectance::metal_reflectance;
use sixfold::optics::spectrum::{line_color, lines, offset_etas};
use sixfold::optics::{Material, wavelengths};

#[test]
fn metals_reflect_head_on_as_their_tables_say() {
    // ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), red, green, blue.
    for (metal, percent) in [
        (Metal::Silver, [99.1, 98.3, 98.0]),
        (Metal::Gold, [96.3, 78.7, 40.8]),
        (Metal::Copper, [94.3, 61.9, 53.9]),
        (Metal::Aluminium, [90.5, 91.5, 92.3]),
        (Metal::Iron, [53.2, 51.2, 49.6]),
    ] {
        for ([n, k], percent) in std::iter::zip(metal.index_rgb(), percent) {
            let found = 100.0 * metal_reflectance(1.0, n, k);
            let closed = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            assert!((found - 100.0 * closed).abs() < 1e-12);
            assert!((found - percent).abs() < 0.051, "{metal:?}: {found}");
        }
        assert_eq!(metal_reflectance(0.0, 0.2, 3.0), 1.0);
    }
}

#[test]
fn glasses_have_their_published_indices() {
    let (d, c, f) = (FRAUNHOFER_D_UM, FRAUNHOFER_C_UM, FRAUNHOFER_F_UM);
    // Half a unit in the last digit that was published, and for measured liquids and stones a whole one.
    type Published<'a> = (Glass, &'a [(f64, f64)], f64, f64);
    let published: [Published; 4] = [
        // Schott's data sheets.
        (
            Glass::Bk7,
            &[(d, 1.51680), (c, 1.51432), (f, 1.52238)],
            6e-6,
            64.17,
        ),
        (
            Glass::Sf10,
            &[(d, 1.72825), (c, 1.72085), (f, 1.74648)],
            6e-6,
            28.41,
        ),
        // Water at 20 degrees in air: helium, sodium and mercury lines.
        (
            Glass::Water,
            &[
                (0.7065, 1.3300),
                (0.5893, 1.3330),
                (0.5016, 1.3364),
                (0.4047, 1.3427),
            ],
            1e-4,
            55.74,
        ),
        (Glass::Diamond, &[(d, 2.4175), (0.5893, 2.417)], 1e-3, 55.3),
    ];
    for (glass, indices, tolerance, abbe) in published {
        for (wavelength, n) in indices {
            let found = glass.index(*wavelength);
            assert!((found - n).abs() < tolerance, "{glass:?}: {found} for {n}");
        }
        let found = glass.abbe_number();
        assert!((found / abbe - 1.0).abs() < 3e-3, "{glass:?}: {found}");
        // Normal dispersion over all the range, and finite beyond.
        let n: Vec<f64> = (0..=400)
            .map(|i| glass.index(0.38 + 1e-3 * f64::from(i)))
            .collect();
        assert!(n.windows(2).all(|n| n[0] > n[1] && n[1] > 1.0));
        assert_eq!(glass.index(0.0), n[0]);
        assert_eq!(glass.index(-1.0), n[0]);
        assert_eq!(glass.index(f64::NAN), n[0]);
        assert_eq!(glass.index(f64::INFINITY), glass.index(0.78));
    }
    // The sodium line to which refractometers are set; against vacuum it would be 1.33335.
    assert!((Glass::Water.index(0.5893) - 1.33299).abs() < 1e-5);
}

#[test]
fn white_stays_white_for_any_number_of_wavelengths() {
    for count in (0..=66).chain([u32::MAX]) {
        let lines = lines(count);
        assert_eq!(lines.len() as u32, count.clamp(1, 64));
        for channel in 0..3 {
            let sum: f64 = lines.iter().map(|line| line.rgb[channel]).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{count}: {sum}");
        }
        assert!(
            lines
                .windows(2)
                .all(|l| l[0].wavelength_um < l[1].wavelength_um)
        );
        assert!(
            lines
                .iter()
                .all(|l| (0.38..=0.78).contains(&l.wavelength_um))
        );
    }
    assert_eq!(lines(1)[0].rgb, [1.0; 3]);
    // Three are about blue, green and red.
    for (line, own) in lines(3).iter().zip([2, 1, 0]) {
        println!("{line:?}");
        for other in (0..3).filter(|c| *c != own) {
            assert!(
                line.rgb[own] > 0.5 && line.rgb[own] > 2.0 * line.rgb[other],
                "{line:?}"
            );
        }
    }
}

#[test]
fn wavelengths_have_their_colours() {
    for (wavelength_um, hue) in [(0.45, 2), (0.53, 1), (0.65, 0)] {
        let color = line_color(wavelength_um);
        assert_eq!(color[hue], 1.0, "{wavelength_um}");
        assert!((0..3).all(|c| c == hue || color[c] < 0.6), "{color:?}");
    }
    // Sodium's line is orange.
    let [red, green, blue] = line_color(0.5893);
    assert!(red == 1.0 && green > 0.1 && green < 0.5 && blue == 0.0);
    for beyond in [f64::NAN, 0.0, 0.2, 2.0, f64::INFINITY] {
        let color = line_color(beyond);
        assert!(color.iter().all(|c| (0.0..=1.0).contains(c)) && color.contains(&1.0));
    }
}

#[test]
fn a_material_has_the_rays_of_its_dispersion() {
    let glass = Material {
        surface: Surface::Glass,
        ..Material::default()
    };
    assert_eq!(wavelengths(&Material::default()).len(), 1);
    let spectral = wavelengths(&glass);
    assert_eq!(spectral.len(), 16);
    // The shorter the wave, the larger the index, the smaller eta.
    assert!(spectral.windows(2).all(|w| w[0].eta < w[1].eta));
    for dispersion in [Dispersion::Offsets, Dispersion::PrintedOffsets] {
        let rays = wavelengths(&Material {
            dispersion,
            ..glass.clone()
        });
        let right = dispersion == Dispersion::Offsets;
        assert_eq!(rays.len(), 3);
        assert_eq!(rays[0].rgb, [0.0, 0.0, 1.0]);
        assert_eq!(rays.windows(2).all(|w| w[0].eta < w[1].eta), right);
        let etas = offset_etas(1.0 / glass.index, dispersion);
        assert_eq!(rays.iter().map(|r| r.eta).rev().collect::<Vec<_>>(), etas);
    }
}
