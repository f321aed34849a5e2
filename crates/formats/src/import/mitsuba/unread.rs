//! Remarks about what the translation has not read.
use super::{context::Import, tree::Element};

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
