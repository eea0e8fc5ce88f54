//! From area to solid angle and back: the only place where `cos θ / d²` is written.

/// Turns a density over a light's area into one over solid angle: `p_ω = p_A d² / cos θ`.
///
/// * `pdf_area` (m⁻²), `distance_squared` (m²)
/// * `cos_light` – cosine between the light's normal and the direction back to the receiver
///
/// Returns (sr⁻¹); `None` edge-on, from behind, at distance 0, or where the density would not be a
/// positive finite number.
#[inline]
#[must_use]
pub fn area_to_solid_angle(pdf_area: f32, distance_squared: f32, cos_light: f32) -> Option<f32> {
    if cos_light <= 0.0 {
        return None;
    }
    let pdf = pdf_area * distance_squared / cos_light;
    (pdf > 0.0 && pdf < f32::INFINITY).then_some(pdf)
}

/// The geometry term of the area form, `G = cos θ_i cos θ' / d²` (m⁻²); 0 from behind on either side.
///
/// * `cos_receiver`, `cos_light` – cosines at the two ends
/// * `distance_squared` (m²), above 0
#[inline]
#[must_use]
pub fn geometry_term(cos_receiver: f32, cos_light: f32, distance_squared: f32) -> f32 {
    cos_receiver.max(0.0) * cos_light.max(0.0) / distance_squared
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_give_the_same_weight() {
        let (cos_i, cos_l, d2, area) = (0.3, 0.7, 5.0, 2.0);
        let pdf = area_to_solid_angle(1.0 / area, d2, cos_l).unwrap();
        let area_form = geometry_term(cos_i, cos_l, d2) * area;
        assert!((cos_i / pdf - area_form).abs() < 1e-6);
    }

    #[test]
    fn degenerate_configurations_give_no_density() {
        assert_eq!(area_to_solid_angle(1.0, 1.0, 0.0), None);
        assert_eq!(area_to_solid_angle(1.0, 1.0, -1.0), None);
        assert_eq!(area_to_solid_angle(1.0, 0.0, 1.0), None);
        assert_eq!(area_to_solid_angle(f32::INFINITY, 1.0, 1.0), None);
        assert_eq!(area_to_solid_angle(1e30, 1e30, 1.0), None);
        assert_eq!(area_to_solid_angle(f32::NAN, 1.0, 1.0), None);
    }
}
