//! Names of Mitsuba 0.6 in those of Mitsuba 2 and 3.
use super::tree::Node;

/// Whether a version is before 2.
pub fn is_old(version: &str) -> bool {
    version.split('.').next().and_then(|major| major.trim().parse::<u32>().ok()).is_some_and(|major| major < 2)
}

/// Renames an element and its name: `lookAt` becomes `lookat`, and `toWorld` becomes `to_world`.
pub fn names(node: &mut Node) {
    if node.tag == "lookAt" {
        node.tag = "lookat".to_owned();
    }
    let is_value = !matches!(node.tag.as_str(), "default" | "ref");
    for (_, value) in node.attributes.iter_mut().filter(|(key, _)| key == "name" && is_value) {
        *value = snake_case(value);
    }
}

/// `toWorld` as `to_world`, `intIOR` as `int_ior`.
fn snake_case(name: &str) -> String {
    let mut result = String::new();
    let mut before = ' ';
    for c in name.chars() {
        if c.is_uppercase() && before.is_lowercase() {
            result.push('_');
        }
        result.extend(c.to_lowercase());
        before = c;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_camel_case_become_snake_case() {
        let names = ["toWorld", "intIOR", "fovAxis", "sampleCount", "alpha", "rrDepth", "diffuseReflectance"];
        let new = ["to_world", "int_ior", "fov_axis", "sample_count", "alpha", "rr_depth", "diffuse_reflectance"];
        assert_eq!(names.map(snake_case), new);
    }

    #[test]
    fn versions_before_2_are_old() {
        assert_eq!(["0.5.0", "0.6", "2.0.0", "2.1.0", "3.0.0", "x"].map(is_old), [true, true, false, false, false, false]);
    }
}
