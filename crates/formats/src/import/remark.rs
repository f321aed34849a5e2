//! Remarks about what was not imported exactly.

/// Something that was not imported exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Where it stands: `scene.xml:12:5`, or `scene.gltf: material "Wood"`.
    pub place: String,
    /// The original: "`<bsdf type=\"hair\">`".
    pub found: String,
    /// The replacement: "grey plastic".
    pub used: String,
    /// The effect on the image: "the strands look like plastic".
    pub effect: String,
}
