//! Keeps WGSL and Rust together without a GPU.
use sixfold::gpu::shader;
use sixfold::mapping::MappingId;

fn parse(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::empty(),
    )
    .validate(&module)
    .map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

#[test]
fn every_assembled_pass_is_valid() {
    parse(&shader::plain("")).unwrap();
    for &id in MappingId::ALL {
        parse(&shader::for_mapping(id, "")).unwrap();
    }
}
