use brinell_exporter::translate::runge_kutta::factor;

#[test]
fn an_error_that_is_no_number_makes_no_step_longer() {
    assert!(factor(1e-12, f64::NAN).is_nan());
    assert!(factor(1e-12, f64::INFINITY) == 0.0 && factor(1e-12, 0.0) > 5.0 && factor(1e-12, 1e-12) < 1.0);
}
