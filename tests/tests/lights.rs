//! Each light passes each check. To add a light: a line here.

use halflight_tests::lights::{self, scaled};

/// The checks that each surface passes, however it is sampled.
macro_rules! conformance {
    ($name:ident, $subject:expr) => {
        mod $name {
            conformance!(@sampled by_area, halflight::light::SurfaceDensity::Area, $subject);
            conformance!(@sampled by_solid_angle, halflight::light::SurfaceDensity::SolidAngle, $subject);
        }
    };
    (solid_angle $name:ident, $subject:expr) => {
        mod $name {
            conformance!(@sampled by_solid_angle, halflight::light::SurfaceDensity::SolidAngle, $subject);
        }
    };
    (projected $name:ident, $subject:expr) => {
        mod $name {
            conformance!(@sampled by_projected, halflight::light::SurfaceDensity::Projected,
                $subject.projected());
        }
    };
    (@sampled $method:ident, $density:expr, $subject:expr) => {
        mod $method {
            use halflight_tests::{Verdict, lights};

            #[test]
            fn queried_density_equals_sampled_density() -> Verdict {
                lights::queried_density_equals_sampled_density(&$subject.by($density))
            }

            #[test]
            fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
                lights::mean_reciprocal_density_is_the_solid_angle(&$subject.by($density))
            }

            #[test]
            fn area_and_direction_sampling_agree() -> Verdict {
                lights::area_and_direction_sampling_agree(&$subject.by($density))
            }

            #[test]
            fn directions_pass_chi_square() -> Verdict {
                lights::directions_pass_chi_square(&$subject.by($density))
            }

            #[test]
            fn nothing_arrives_from_behind() -> Verdict {
                lights::nothing_arrives_from_behind(&$subject.by($density))
            }

            #[test]
            fn inverse_returns_the_uniforms() -> Verdict {
                lights::inverse_returns_the_uniforms($subject.light.shape())
            }

            #[test]
            fn view_inverse_returns_the_uniforms() -> Verdict {
                lights::view_inverse_returns_the_uniforms(&$subject.by($density))
            }

            #[test]
            fn extreme_distances_stay_finite() -> Verdict {
                lights::extreme_distances_stay_finite(&$subject.by($density))
            }
        }
    };
}

conformance!(rectangle_overhead, lights::rectangle_overhead());
conformance!(rectangle_near, lights::rectangle_near());
conformance!(rectangle_far_away, lights::rectangle_far_away());
conformance!(rectangle_grazing, lights::rectangle_grazing());
conformance!(rectangle_two_sided, lights::rectangle_two_sided());
conformance!(disk_overhead, lights::disk_overhead());
conformance!(disk_as_ellipse_aside, lights::disk_as_ellipse_aside());
conformance!(disk_two_sided, lights::disk_two_sided());
conformance!(sphere_ahead, lights::sphere(1.0, 3.0));
conformance!(sphere_near, lights::sphere(1.0, 1.05));
conformance!(sphere_far_away, lights::sphere(1.0, 1e3));
conformance!(sphere_two_sided, lights::sphere_two_sided());
conformance!(sphere_from_inside, lights::sphere_from_inside());
conformance!(sphere_from_its_wall, lights::sphere_from_its_wall());
conformance!(solid_angle sphere_touched, lights::sphere(1.0, 1.001));
conformance!(projected sphere_projected, lights::sphere(1.0, 3.0));
conformance!(projected sphere_projected_near, lights::sphere(1.0, 1.001));
conformance!(projected sphere_projected_far_away, lights::sphere(1.0, 1e3));
conformance!(projected sphere_projected_from_inside, lights::sphere_from_inside());
conformance!(projected sphere_half_set, lights::sphere_at_the_horizon(1.0, 1.5, 0.2));
conformance!(projected sphere_almost_risen, lights::sphere_at_the_horizon(1.0, 3.0, 0.3));
conformance!(projected sphere_almost_set, lights::sphere_at_the_horizon(1.0, 2.0, -0.3));
conformance!(projected sphere_touched_and_set, lights::sphere_at_the_horizon(1.0, 1.001, -0.5));
conformance!(disk_near, lights::disk_near());
conformance!(disk_far_away, lights::disk_far_away());
conformance!(disk_grazing, lights::disk_grazing());
conformance!(disk_aslant, lights::disk_aslant());
conformance!(cylinder_near, lights::cylinder_near());
conformance!(cylinder_far_away, lights::cylinder_far_away());
conformance!(triangle_overhead, lights::triangle_overhead());
conformance!(triangle_far_away, lights::triangle_far_away());
conformance!(triangle_two_sided, lights::triangle_two_sided());
conformance!(triangle_near, lights::triangle_near());
conformance!(triangle_needle, lights::triangle_needle());
conformance!(triangle_grazing, lights::triangle_grazing());
conformance!(polygon_overhead, lights::polygon_overhead());
conformance!(polygon_near, lights::polygon_near());
conformance!(polygon_far_away, lights::polygon_far_away());
conformance!(polygon_two_sided, lights::polygon_two_sided());
conformance!(cylinder_beside, lights::cylinder_beside());
conformance!(cylinder_from_inside, lights::cylinder_from_inside());

/// What surfaces with a picture pass, however they are sampled.
macro_rules! painted_conformance {
    ($name:ident, $subject:expr) => {
        mod $name {
            use halflight::light::SurfaceDensity;
            use halflight_tests::{Verdict, lights};

            fn by_each(check: impl Fn(SurfaceDensity) -> Verdict) -> Verdict {
                check(SurfaceDensity::Area)?;
                check(SurfaceDensity::SolidAngle)?;
                check(SurfaceDensity::Auto)
            }

            #[test]
            fn queried_density_equals_sampled_density() -> Verdict {
                by_each(|density| lights::queried_density_equals_sampled_density(&$subject.by(density)))
            }

            #[test]
            fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
                by_each(|density| lights::mean_reciprocal_density_is_the_solid_angle(&$subject.by(density)))
            }

            #[test]
            fn area_and_direction_sampling_agree() -> Verdict {
                by_each(|density| lights::area_and_direction_sampling_agree(&$subject.by(density)))
            }

            #[test]
            fn directions_pass_chi_square() -> Verdict {
                by_each(|density| lights::directions_pass_chi_square(&$subject.by(density)))
            }
        }
    };
}

painted_conformance!(painted_rectangle_overhead, lights::painted_rectangle(lights::rectangle_overhead()));
painted_conformance!(painted_rectangle_near, lights::painted_rectangle(lights::rectangle_near()));
painted_conformance!(painted_triangle_overhead, lights::painted_triangle(lights::triangle_overhead()));
painted_conformance!(painted_sphere_ahead, lights::painted_sphere(lights::sphere(1.0, 3.0)));

/// The same for a light around the scene.
mod constant_over_a_slope {
    use halflight_tests::{Verdict, lights};

    #[test]
    fn queried_density_equals_sampled_density() -> Verdict {
        lights::queried_density_equals_sampled_density(&lights::constant_over_a_slope())
    }

    #[test]
    fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
        lights::mean_reciprocal_density_is_the_solid_angle(&lights::constant_over_a_slope())
    }

    #[test]
    fn area_and_direction_sampling_agree() -> Verdict {
        lights::area_and_direction_sampling_agree(&lights::constant_over_a_slope())
    }

    #[test]
    fn directions_pass_chi_square() -> Verdict {
        lights::directions_pass_chi_square(&lights::constant_over_a_slope())
    }
}

/// Each check notices a density that is 2 % off.
mod two_percent_are_noticed {
    use super::*;
    use halflight_tests::lights::Lying;

    #[test]
    fn by_the_comparison_of_densities() {
        let lying = Lying { subject: lights::rectangle_overhead(), sampled: 1.02, queried: [1.0; 2] };
        assert!(lights::queried_density_equals_sampled_density(&lying).is_err());
    }

    #[test]
    fn by_the_mean_of_reciprocals() {
        let lying = scaled(lights::rectangle_overhead(), 1.02);
        assert!(lights::mean_reciprocal_density_is_the_solid_angle(&lying).is_err());
        let lying = scaled(lights::painted_rectangle(lights::rectangle_overhead()), 1.02);
        assert!(lights::mean_reciprocal_density_is_the_solid_angle(&lying).is_err());
        let lying = scaled(lights::constant_over_a_slope(), 1.02);
        assert!(lights::mean_reciprocal_density_is_the_solid_angle(&lying).is_err());
    }

    #[test]
    fn by_the_two_ways_to_the_irradiance() {
        let lying = scaled(lights::rectangle_overhead(), 1.02);
        assert!(lights::area_and_direction_sampling_agree(&lying).is_err());
    }

    #[test]
    fn by_the_histogram() {
        let lying = scaled(lights::rectangle_overhead(), 1.02);
        assert!(lights::directions_pass_chi_square(&lying).is_err());
        let lying = scaled(lights::painted_rectangle(lights::rectangle_near()), 1.02);
        assert!(lights::directions_pass_chi_square(&lying).is_err());
        // Right in total, wrong in its shape.
        let lying = Lying { subject: lights::rectangle_overhead(), sampled: 1.0, queried: [1.02, 0.98] };
        assert!(lights::directions_pass_chi_square(&lying).is_err());
    }
}
