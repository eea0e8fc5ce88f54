//! Conformance, statistics and closed forms, in one binary.

mod bsdf_values;
mod bsdfs;
mod bvh;
mod choosing;
mod closed_forms;
mod control_variates;
mod delta;
mod environments;
mod estimators;
mod extremes;
mod invariance;
mod lights;
mod outsider;
mod paths;
mod pictures;
mod portals;
mod properties;
mod sequences;
mod shapes;

/// Every kind of light has its line in the conformance suite.
#[test]
fn no_light_goes_untested() {
    let suite = concat!(
        include_str!("lights.rs"),
        include_str!("delta.rs"),
        include_str!("environments.rs"),
        include_str!("portals.rs")
    );
    for name in halflight::light::AnyLight::NAMES.map(|name| name.replace(' ', "_")) {
        let stamped =
            suite.contains(&format!("conformance!({name}_")) || suite.contains(&format!("mod {name}_"));
        assert!(stamped, "no conformance! line for {name}");
    }
}
