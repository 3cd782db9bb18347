//! `sixfold metrics`.

use sixfold::mapping::MappingId;

use super::run;

/// The fields that other programs read.
const FIELDS: [&str; 15] = [
    "mapping",
    "charts",
    "area_ratio",
    "area_rms",
    "anisotropy_mean",
    "anisotropy_max",
    "omega_mean_deg",
    "omega_max_deg",
    "worst_linear",
    "texel_budget",
    "edge_ratio",
    "diagonal_ratio",
    "solid_angle_sum_sr",
    "equal_area",
    "conformal",
];

#[test]
fn json_has_the_promised_fields_and_says_what_is_unbounded() {
    let found = run(&["metrics", "--json", "cube", "latlong"], "");
    assert_eq!((found.status, found.err.as_str()), (0, ""));
    let list: Vec<serde_json::Map<String, serde_json::Value>> =
        serde_json::from_str(&found.out).unwrap();
    for (row, id) in list.iter().zip(["cube", "latlong"]) {
        assert_eq!(row["mapping"], id);
        let keys: Vec<&str> = row.keys().map(String::as_str).collect();
        assert!(FIELDS.iter().all(|field| keys.contains(field)), "{keys:?}");
        assert_eq!(keys.len(), FIELDS.len(), "{keys:?}");
    }
    let ratio = list[0]["area_ratio"].as_f64().unwrap();
    assert!((ratio - 27f64.sqrt()).abs() < 1e-12, "{ratio}");
    assert_eq!(list[1]["area_ratio"], "unbounded");
    assert_eq!(list[1]["omega_max_deg"], 180.0);
}

#[test]
fn the_table_has_a_line_for_every_mapping_and_a_wrong_name_is_refused() {
    let table = run(&["metrics"], "");
    assert_eq!(table.status, 0);
    let ids = table.out.lines().map(|l| l.split(' ').next().unwrap());
    let maps = MappingId::ALL.iter().map(|map| map.info().id);
    assert!(ids.eq(std::iter::once("MAP").chain(maps)), "{}", table.out);
    let wrong = run(&["metrics", "cuboid"], "");
    assert_eq!((wrong.status, wrong.out.as_str()), (2, ""));
    assert_eq!(wrong.err.lines().count(), 1, "{}", wrong.err);
}
