//! Damaged models: no panic, no result beyond the laws.

use super::document::{Document, U16};
use super::fixtures::{POSITIONS, check, open, tetrahedron_obj};

fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

/// Puts another number in the place of one that is written out.
fn replace_number(bytes: &mut Vec<u8>, state: &mut u64) {
    const NUMBERS: [&str; 10] = [
        "0",
        "-1",
        "2",
        "5",
        "1e39",
        "-0.5",
        "65535",
        "4294967295",
        "4611686018427387904",
        "nan",
    ];
    let start = (next(state) % bytes.len() as u64) as usize;
    let Some(start) = (start..bytes.len()).find(|&at| bytes[at].is_ascii_digit()) else {
        return;
    };
    let digits = bytes[start..].iter().take_while(|b| b.is_ascii_digit());
    let end = start + digits.count();
    let number = NUMBERS[(next(state) % NUMBERS.len() as u64) as usize];
    bytes.splice(start..end, number.bytes());
}

fn seeds() -> [(&'static str, Vec<u8>); 3] {
    let mut document = Document::tetrahedron(U16);
    let normals = document.vectors(&POSITIONS.map(|p| p.map(|x| x + 0.1)));
    document.primitive()["attributes"]["NORMAL"] = normals.into();
    let places = document.view(&[1, 0, 3, 0]);
    document.json["accessors"][0]["sparse"] = serde_json::json!({
        "count": 2,
        "indices": { "bufferView": places, "componentType": U16 },
        "values": { "bufferView": 0 },
    });
    document.json["nodes"] = serde_json::json!([
        { "children": [1], "translation": [1, 2, 3] }, { "mesh": 0, "scale": [2, 2, 2] },
    ]);
    let normals = "vn 1 0 0\nvn 0 1 0\no a\nf 1//1 2//2 4//1\nf -1 -2 -3 -4\nl 1 2\n";
    [
        ("here.glb", document.glb()),
        ("here.gltf", document.data_uri().into_bytes()),
        ("here.obj", (tetrahedron_obj() + normals).into_bytes()),
    ]
}

/// `SIXFOLD_MUTATIONS` sets the rounds of a longer run.
#[test]
fn mutated_models_never_panic() {
    let rounds: u64 = std::env::var("SIXFOLD_MUTATIONS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(2000);
    for (name, whole) in seeds() {
        assert!(
            open(whole.clone(), name).is_ok(),
            "{name}: the whole does not open"
        );
        let (mut state, mut opened, mut refused) = (0x9E37_79B9_7F4A_7C15, 0, 0);
        for round in 0..rounds {
            let mut bytes = whole.clone();
            for _ in 0..=next(&mut state) % 4 {
                let at = (next(&mut state) % bytes.len() as u64) as usize;
                match next(&mut state) % 5 {
                    0 => bytes[at] = next(&mut state) as u8,
                    1 => bytes[at] ^= 1 << (next(&mut state) % 8),
                    2 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][(next(&mut state) % 5) as usize],
                    3 => drop(bytes.remove(at)),
                    _ => replace_number(&mut bytes, &mut state),
                }
            }
            match open(bytes, name) {
                Ok(loaded) => {
                    opened += 1;
                    if let Err(fault) = check(&loaded.mesh) {
                        panic!("{name}, round {round}: {fault}");
                    }
                }
                Err(error) => {
                    refused += 1;
                    let text = error.to_string();
                    assert!(text.ends_with(&format!(": {name}")) && !text.contains('\n'));
                    // A parser that panicked was caught; none is known to.
                    assert!(!text.contains("gave up"), "{name}, round {round}: {text}");
                }
            }
        }
        // Both happen, or the mutations test nothing.
        assert!(
            opened > rounds / 50 && refused > rounds / 50,
            "{name}: {opened} opened, {refused} refused"
        );
    }
}
