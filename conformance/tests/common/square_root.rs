//! The service of the manual's example of the Service Interface, which computes square roots.

/// Returns the response and the response state for a request. The manual's example is C code with
/// `atof`, `sqrt` and `%f`.
pub(crate) fn square_root(request: &str) -> (String, u32) {
    let digits = request.trim_start();
    let x = (0..=digits.len()).rev().find_map(|len| digits.get(..len)?.parse().ok());
    let x: f64 = x.unwrap_or(0.0);
    if x >= 0.0 {
        return (format!("{:.6}", x.sqrt()), 1);
    }
    (format!("ERROR: cannot calc square root of negative number {x:.6}"), 99)
}
