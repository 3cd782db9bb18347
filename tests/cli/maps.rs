//! `sixfold maps`.

use sixfold::mapping::MappingId;

use super::run;

#[test]
fn maps_lists_every_mapping() {
    let table = run(&["maps"], "");
    assert_eq!((table.status, table.err.as_str()), (0, ""));
    let ids: Vec<&str> = table
        .out
        .lines()
        .map(|l| l.split(' ').next().unwrap())
        .collect();
    assert_eq!(ids[0], "ID");
    let maps: Vec<&str> = MappingId::ALL.iter().map(|map| map.info().id).collect();
    assert_eq!(ids[1..], maps);
    let column = table.out.lines().next().unwrap().find("SOURCE").unwrap();
    for line in table.out.lines() {
        let at: String = line.chars().skip(column - 2).take(3).collect();
        assert!(
            at.starts_with("  ") && !at.ends_with(' '),
            "columns do not line up: {line}"
        );
    }

    let json: serde_json::Value = serde_json::from_str(&run(&["maps", "--json"], "").out).unwrap();
    let list = json.as_array().unwrap();
    assert_eq!(list.len(), maps.len());
    for (entry, id) in list.iter().zip(maps) {
        assert_eq!(entry["id"], id);
        for key in [
            "name",
            "family",
            "charts",
            "coverage",
            "conventions",
            "evaluators",
            "source",
        ] {
            assert!(!entry[key].is_null(), "{id} has no {key}");
        }
        // Every name in the list is accepted; without the explorer shaders are named, but nothing runs them.
        for (key, option) in [
            ("conventions", "--convention"),
            ("evaluators", "--evaluator"),
        ] {
            for named in entry[key].as_array().unwrap() {
                let name = named["id"].as_str().unwrap();
                let runs = named["device"] != "gpu" || cfg!(feature = "explorer");
                assert_eq!(
                    run(&["eval", id, option, name], "1,2,3\n").status,
                    i32::from(!runs),
                    "{id} {name}"
                );
            }
        }
    }
}
