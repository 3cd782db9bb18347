//! Published and high-precision values: the tables under tests/golden hold exact f32 inputs and 25-digit results.

use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::{Real, Vec3};

/// One row of a table: direction and expected chart point.
struct Row {
    dir: Vec3<f64>,
    expected: ChartPoint<f64>,
}

fn table(name: &str) -> Vec<Row> {
    let path = format!("{}/tests/golden/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let rows: Vec<Row> = text
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            Row {
                dir: Vec3::new(number(0), number(1), number(2)),
                expected: ChartPoint::new(cells[3].parse().unwrap(), number(4), number(5)),
            }
        })
        .collect();
    assert!(rows.len() >= 339, "{name} has only {} rows", rows.len());
    rows
}

/// Largest |u| or |v| difference over a table; a wrong chart index counts as 1.
fn worst<R: Real>(rows: &[Row], forward: impl Fn(Vec3<R>) -> Option<ChartPoint<R>>) -> f64 {
    rows.iter()
        .map(|row| {
            let Some(got) = forward(Vec3::from_f64(row.dir.to_f64())) else {
                return 1.0;
            };
            let got = got.to_f64();
            if got.chart != row.expected.chart {
                return 1.0;
            }
            (got.u - row.expected.u)
                .abs()
                .max((got.v - row.expected.v).abs())
        })
        .fold(0.0, f64::max)
}

/// Holds an observed error against its budget, and the budget against the observed error.
fn hold(what: &str, observed: f64, budget: f64) {
    println!("{what}: observed {observed:.3e}, budget {budget:.1e}");
    assert!(
        observed <= budget,
        "{what}: observed {observed:.3e} > budget {budget:.1e}"
    );
}

#[test]
fn every_mapping_in_both_precisions() {
    for &id in MappingId::ALL {
        let rows = table(id.info().id);
        hold(
            &format!("{id} f64"),
            worst(&rows, |d: Vec3<f64>| id.forward(d)),
            5e-15,
        );
        hold(
            &format!("{id} f32"),
            worst(&rows, |d: Vec3<f32>| id.forward(d)),
            4e-7,
        );
        // Negative control: the same rows with the handedness turned round must fail.
        let mirrored = worst(&rows, |d: Vec3<f64>| id.forward(Vec3::new(-d.x, d.y, d.z)));
        assert!(mirrored > 0.1, "{id}: the comparison cannot fail");
    }
}

#[test]
fn the_papers_own_numbers() {
    let rows = table("ccm-paper");
    let paper = MappingId::Ccm.info().convention("paper").unwrap();
    hold("ccm paper f64", worst(&rows, paper.forward.1), 5e-15);
    hold("ccm paper f32", worst(&rows, paper.forward.0), 4e-7);
    let printed = MappingId::Ccm.info().convention("printed-eq6").unwrap();
    assert!(
        worst(&rows, printed.forward.1) > 0.2,
        "the printed Eq. 6 must be off"
    );
}
