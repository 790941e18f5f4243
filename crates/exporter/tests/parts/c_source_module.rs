use brinell_exporter::c_source::module::{ModuleError, c_text};

/// What wasm2c says of a module whose fmi2DoStep has these lines.
fn text(lines: &str) -> String {
    format!(
        "  instance->w2c___stack_pointer = 65536u;\n  instance->w2c_brinell_block = 65552u;\n  instance->w2c___data_end = {}u;\n\
         static const u8 data[] = {{\n  0x00, 0x00, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00, \n  0x08, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, \n}};\n\
         static void init_memories(Z_unit_instance_t* instance) {{\n  LOAD_DATA(instance->w2c_memory, 65536u, data, 16);\n}}\n\
         static const wasm_elem_segment_expr_t elem_segment_exprs_w2c_e0[] = {{\n  {{0, (wasm_rt_function_ptr_t)&w2c_law, 0}},\n}};\n\
         static u32 w2c_brinell_fixed_size(Z_unit_instance_t* instance) {{\n  w2c_i0 = 16u;\n}}\n\
         static f64 w2c__ZN4libm4math4sqrt4sqrt17hE(Z_unit_instance_t* instance, f64 w2c_p0) {{\n}}\n\
         static f64 w2c_law(Z_unit_instance_t* instance, f64 w2c_p0) {{\n  w2c_i0 = instance->w2c___stack_pointer;\n  w2c_i1 = 48u;\n  w2c_i0 -= w2c_i1;\n}}\n\
         static u32 w2c_fmi2DoStep(Z_unit_instance_t* instance, u32 w2c_p0, f64 w2c_p1, f64 w2c_p2, u32 w2c_p3) {{\n{lines}}}\n",
        65552 + size_of::<brinell_fmu::scene::library::block::Block>()
    )
}

#[test]
fn the_call_of_a_method_becomes_a_switch_over_those_at_its_place() {
    let call = |place: u32| {
        text(&format!(
            "  w2c_i1 = i32_load(&instance->w2c_memory, (u64)(w2c_i1) + {place}u);\n  w2c_d0 = CALL_INDIRECT(instance->w2c_T0, \
             f64 (*)(void*, f64), 0, w2c_i1, instance->w2c_T0.data[w2c_i1].module_instance, w2c_d0);\n  w2c_d0 *= w2c_d1;\n"
        ))
    };
    let made = c_text(&call(12), "state").unwrap();
    assert!(made.contains("d0 = method_0_12(m, i1, d0);\nd0 *= d1; OPAQUE(d0);\n"), "{made}");
    assert!(made.contains("case 1: return fn2(m, p0);") && made.contains("#define STACK_SIZE 48u"), "{made}");
    // no method is at another place
    let made = c_text(&call(16), "state").unwrap();
    assert!(!made.contains("case 1:") && made.contains("#define STACK_SIZE 0u"), "{made}");
}

#[test]
fn a_module_without_a_bound_with_too_small_a_stack_or_with_a_panic_path_is_refused() {
    let recursive = c_text(&text("  w2c_i0 = w2c_fmi2DoStep(instance, w2c_i0, w2c_d0, w2c_d1, w2c_i1);\n"), "state");
    assert!(matches!(recursive, Err(ModuleError::Recursion(name)) if name == "w2c_fmi2DoStep"));
    let deep = "  w2c_i0 = instance->w2c___stack_pointer;\n  w2c_i1 = 65552u;\n  w2c_i0 -= w2c_i1;\n";
    let deep = c_text(&text(deep), "state");
    assert!(matches!(deep, Err(ModuleError::Stack { needed: 65552, given: 65536 })), "{deep:?}");
    let panics = c_text(&text("  (*Z_envZ_brinell_a_panic_path_survived)(instance->Z_env_instance);\n"), "state");
    assert!(matches!(panics, Err(ModuleError::Import(name)) if name == "brinell_a_panic_path_survived"));
}
