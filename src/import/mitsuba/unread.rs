//! Remarks about what the translation has not read.
use super::{context::Import, tree::Element};
use crate::{material::Material, scene::description::Textured};

/// Objects that change nothing unless others refer to them.
const DEFINITIONS: [&str; 8] = ["bsdf", "texture", "spectrum", "shape", "medium", "volume", "phase", "film"];

/// Adds a remark for each element that nothing has read, within elements that were read.
pub fn report(import: &mut Import, root: Element) {
    let mut stack = vec![(root, true)];
    while let Some((element, is_root)) = stack.pop() {
        for child in element.children() {
            if child.is_seen() {
                stack.push((child, false));
            } else if !(is_root && DEFINITIONS.contains(&child.tag())) && child.tag() != "ref" {
                import.remark(child, "nothing", "it has no effect");
            }
        }
    }
}

/// Marks an element and all within it as read.
pub fn skip(element: Element) {
    let mut open = vec![element];
    while let Some(element) = open.pop() {
        element.see();
        open.extend(element.children());
    }
}

/// A remark if the depth of paths is limited and some surface lets light pass: Mitsuba counts the passage.
pub fn crossings(import: &mut Import) {
    if import.description.render.settings.max_bounces.is_none() {
        return;
    }
    let passes = import.description.materials.iter().find(|(_, material)| {
        let is_open = material.opacity.as_ref().is_some_and(|opacity| *opacity != Textured::Constant(1.0));
        is_open || matches!(material.kind, Material::Null(_))
    });
    if let Some((name, _)) = passes {
        let place = format!("material \"{name}\"");
        let found = "a limit of the depth of paths, which counts the passage through masks";
        import.remarks.add(place, found, "a limit of reflections", "what is seen through the mask gets more light");
    }
}
