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
        "1",
        "2",
        "3",
        "5",
        "12",
        "-1",
        "1e39",
        "4294967295",
        "4611686018427387904",
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

/// Makes the lengths of the file and of its text right again, after the text has grown.
fn repair_glb(bytes: &mut [u8], grown: i64) {
    for at in [8, 12] {
        let Some(place) = bytes.get_mut(at..at + 4) else {
            return;
        };
        let length = u32::from_le_bytes((&*place).try_into().unwrap());
        place.copy_from_slice(&((i64::from(length) + grown) as u32).to_le_bytes());
    }
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
            // Every other round keeps the text readable, so that damage reaches what stands behind it.
            let is_gentle = round % 2 == 1;
            let damages = 1 + next(&mut state) % if is_gentle { 2 } else { 4 };
            for _ in 0..damages {
                let at = (next(&mut state) % bytes.len() as u64) as usize;
                match next(&mut state) % 5 {
                    _ if is_gentle => replace_number(&mut bytes, &mut state),
                    0 => bytes[at] = next(&mut state) as u8,
                    1 => bytes[at] ^= 1 << (next(&mut state) % 8),
                    2 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][(next(&mut state) % 5) as usize],
                    3 => drop(bytes.remove(at)),
                    _ => replace_number(&mut bytes, &mut state),
                }
            }
            if is_gentle && name.ends_with("glb") {
                let grown = bytes.len() as i64 - whole.len() as i64;
                repair_glb(&mut bytes, grown);
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
        println!("{name}: {rounds} rounds, {opened} opened, {refused} refused");
        // Both happen, or the mutations test nothing.
        assert!(
            opened > rounds / 20 && refused > rounds / 20,
            "{name}: {opened} opened, {refused} refused"
        );
    }
}
