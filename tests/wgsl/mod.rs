//! Reading shaders without a GPU, for every test that holds WGSL against Rust.
#![allow(
    dead_code,
    reason = "each test that includes this file uses a part of it"
)]

/// The module, or where the text is wrong.
pub fn parse(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    // No capabilities: what is valid here needs no optional feature of the device.
    naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::empty(),
    )
    .validate(&module)
    .map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

/// Panics unless the struct has exactly these members at these byte offsets, in this order, and this size:
/// `assert_layout(pass, "Globals", &[("eye", offset_of!(Globals, eye)), ...], size_of::<Globals>())`.
pub fn assert_layout(wgsl: &str, name: &str, members: &[(&str, usize)], size: usize) {
    if let Err(fault) = check_layout(wgsl, name, members, size) {
        panic!("{fault}");
    }
}

/// [`assert_layout`] for a test that expects a fault.
pub fn check_layout(
    wgsl: &str,
    name: &str,
    members: &[(&str, usize)],
    size: usize,
) -> Result<(), String> {
    let module = parse(wgsl)?;
    let found = module
        .types
        .iter()
        .find(|(_, ty)| ty.name.as_deref() == Some(name))
        .ok_or_else(|| format!("no struct {name}"))?;
    let naga::TypeInner::Struct {
        members: there,
        span,
    } = &found.1.inner
    else {
        return Err(format!("{name} is no struct"));
    };
    let there: Vec<(&str, usize)> = there
        .iter()
        .map(|m| (m.name.as_deref().unwrap_or(""), m.offset as usize))
        .collect();
    if there != members {
        return Err(format!("{name}: WGSL has {there:?}, Rust {members:?}"));
    }
    if *span as usize != size {
        return Err(format!("{name}: WGSL has {span} bytes, Rust {size}"));
    }
    Ok(())
}

/// Every constant of a module that is one number or truth value.
pub fn constants(module: &naga::Module) -> Vec<(String, naga::Literal)> {
    module
        .constants
        .iter()
        .filter_map(|(_, constant)| {
            let name = constant.name.clone()?;
            match module.global_expressions[constant.init] {
                naga::Expression::Literal(literal) => Some((name, literal)),
                _ => None,
            }
        })
        .collect()
}

/// The text without `//` and `/* */` comments (which nest).
pub fn without_comments(text: &str) -> String {
    let (mut out, mut rest, mut depth) = (String::new(), text, 0);
    while let Some(c) = rest.chars().next() {
        if rest.starts_with("/*") {
            depth += 1;
            rest = &rest[2..];
        } else if depth > 0 && rest.starts_with("*/") {
            depth -= 1;
            rest = &rest[2..];
        } else if depth == 0 && rest.starts_with("//") {
            rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
        } else {
            if depth == 0 {
                out.push(c);
            }
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

/// Those of `names` that the text calls, comments apart.
pub fn calls<'a>(text: &str, names: &[&'a str]) -> Vec<&'a str> {
    let text = without_comments(text);
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let called = |name: &str| {
        text.match_indices(name).any(|(at, _)| {
            !text[..at].ends_with(is_name) && text[at + name.len()..].trim_start().starts_with('(')
        })
    };
    names.iter().copied().filter(|name| called(name)).collect()
}

/// (path below shaders/, text) of every shader file.
pub fn files() -> Vec<(String, String)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let (mut found, mut folders) = (Vec::new(), vec![root.clone()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                let name = path.strip_prefix(&root).unwrap().to_str().unwrap();
                found.push((
                    name.replace('\\', "/"),
                    std::fs::read_to_string(&path).unwrap(),
                ));
            }
        }
    }
    found.sort();
    found
}
