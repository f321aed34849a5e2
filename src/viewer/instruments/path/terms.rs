//! The rows of the path table: a term of the sum each, and the rows that close the sum.
use noisefall_kernel::integrator::{EmitterHit, LightOutcome, Replay, SampledLight, Vertex};

type Colour = [f32; 3];

/// A row of a vertex.
pub struct Row<'a> {
    pub vertex: &'a Vertex,
    /// `None` if the vertex adds nothing: it does not emit, and no light is sampled.
    pub term: Option<Term>,
}

/// A term of the sum: the product of its factors, of which some are 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    pub source: TermSource,
    /// Throughput and transmittance up to the vertex.
    pub throughput: Colour,
    pub f_cos: Option<Colour>,
    pub radiance: Colour,
    /// Transmittance and visibility towards the light.
    pub passed: Option<Colour>,
    pub weight: f32,
    pub pdf: Option<f32>,
    pub value: Colour,
    /// It is divided among the pixels of a block.
    pub is_shared: bool,
}

/// Source of the light of a term.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TermSource {
    /// The path runs into it.
    Hit,
    /// A light that was sampled.
    Light(LightId, LightOutcome),
}

/// Which light was sampled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightId {
    Object(u32),
    /// A punctual light, by its name.
    PunctualLight(String),
    Environment,
}

/// A row that closes the sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Total {
    pub name: String,
    pub doc: &'static str,
    pub value: Colour,
}

/// The rows of the first vertices.
pub fn rows(replay: &Replay, most_vertices: usize) -> Vec<Row<'_>> {
    let rows = |vertex| {
        let terms: Vec<Term> = terms(vertex).collect();
        let none = if terms.is_empty() { Some(Row { vertex, term: None }) } else { None };
        none.into_iter().chain(terms.into_iter().map(move |term| Row { vertex, term: Some(term) }))
    };
    replay.vertices.iter().take(most_vertices).flat_map(rows).collect()
}

fn terms(vertex: &Vertex) -> impl Iterator<Item = Term> {
    let throughput = [0, 1, 2].map(|c| vertex.throughput[c] * vertex.transmittance[c]);
    let hit = vertex.emission.as_ref().map(|hit| of_hit(throughput, hit));
    hit.into_iter().chain(vertex.light.as_ref().map(|light| of_light(throughput, light)))
}

fn of_hit(throughput: Colour, hit: &EmitterHit) -> Term {
    Term {
        source: TermSource::Hit,
        throughput,
        f_cos: None,
        radiance: hit.radiance,
        passed: None,
        weight: hit.weight,
        pdf: None,
        value: hit.contribution,
        is_shared: hit.shared,
    }
}

fn of_light(throughput: Colour, light: &SampledLight) -> Term {
    Term {
        source: TermSource::Light(target(light), light.outcome),
        throughput,
        f_cos: Some(light.f_cos),
        radiance: light.radiance,
        passed: Some(light.passed),
        weight: light.weight,
        pdf: Some(light.pdf),
        value: light.contribution,
        is_shared: light.shared,
    }
}

fn target(light: &SampledLight) -> LightId {
    match (&light.punctual_light, light.object) {
        (Some(punctual_light), _) => LightId::PunctualLight(punctual_light.clone()),
        (None, Some(object)) => LightId::Object(object),
        (None, None) => LightId::Environment,
    }
}

/// The rows below those of the vertices. With the terms that are not shared they add up to the last one, the sample.
pub fn totals(replay: &Replay, most_vertices: usize) -> Vec<Total> {
    let mut totals = Vec::new();
    if let Some(further) = replay.vertices.len().checked_sub(most_vertices).filter(|further| *further > 0) {
        let terms = replay.vertices.iter().skip(most_vertices).flat_map(terms).filter(|term| !term.is_shared);
        let value = terms.fold([0.0; 3], |sum: Colour, term| [0, 1, 2].map(|c| sum[c] + term.value[c]));
        let vertices = if further == 1 { "vertex" } else { "vertices" };
        totals.push(Total { name: format!("{further} more {vertices}"), doc: "Sum of the terms that are not listed.", value });
    }
    if let Some(shared) = &replay.shared {
        totals.push(Total {
            name: "Shared, kept".to_owned(),
            doc: "Part of the terms in brackets that this pixel keeps, by multiple importance sampling.",
            value: shared.kept,
        });
        totals.push(Total {
            name: "From neighbours".to_owned(),
            doc: "Parts that this pixel gets from the paths of the other pixels in the 4 × 4 block.",
            value: shared.from_neighbours,
        });
    }
    totals.push(Total {
        name: "Sample".to_owned(),
        doc: "Sum of the column, without the terms in brackets.",
        value: replay.radiance,
    });
    totals
}

#[cfg(test)]
mod tests {
    use noisefall_kernel::integrator::replay;
    use noisefall_scene::scene::{RenderSettings, Reuse, built_in};

    use super::*;

    #[test]
    fn terms_are_products_and_add_up_to_the_sample_with_and_without_path_reuse() {
        let scene = built_in();
        let rays = scene.rays(&scene.camera);
        let (mut checked, mut shared) = (0, 0);
        for (reuse, sample) in
            [Reuse::Off, Reuse::Suffixes, Reuse::Both].into_iter().flat_map(|reuse| (0..40).map(move |sample| (reuse, sample)))
        {
            let settings = RenderSettings { reuse, ..scene.settings };
            let middle = scene.camera.resolution.map(|side| side / 3);
            let replay = replay(&scene, &rays, &settings, middle, sample);
            for most_vertices in [64, 1] {
                let mut sum = [0.0; 3];
                for term in rows(&replay, most_vertices).into_iter().filter_map(|row| row.term) {
                    for c in 0..3 {
                        let of = |factor: Option<Colour>| factor.map_or(1.0, |factor| factor[c]);
                        let product = term.throughput[c] * of(term.f_cos) * term.radiance[c] * of(term.passed) * term.weight;
                        let product = product / term.pdf.filter(|pdf| *pdf > 0.0).unwrap_or(1.0);
                        assert!((product - term.value[c]).abs() <= 1e-4 * product.abs() + 1e-9, "{term:?}");
                        sum[c] += if term.is_shared { 0.0 } else { term.value[c] };
                    }
                    (checked, shared) = (checked + 1, shared + u32::from(term.is_shared));
                }
                let totals = totals(&replay, most_vertices);
                let (sample, others) = totals.split_last().expect("there is always the sample");
                let whole = [0, 1, 2].map(|c| sum[c] + others.iter().map(|total| total.value[c]).sum::<f32>());
                assert!((0..3).all(|c| (whole[c] - sample.value[c]).abs() <= 1e-4 * whole[c] + 1e-6), "{whole:?} {totals:?}");
                assert_eq!(sample.value, replay.radiance);
            }
        }
        assert!(checked > 200 && shared > 20, "{checked} {shared}");
    }

    #[test]
    fn a_vertex_that_adds_nothing_has_a_row_too() {
        let replay = Replay { vertices: vec![blank()], ..Replay::default() };
        let rows = rows(&replay, 64);
        assert!(rows.len() == 1 && rows[0].term.is_none());
        assert_eq!(totals(&replay, 64).len(), 1);
    }

    fn blank() -> Vertex {
        let zero = [0.0; 3];
        Vertex {
            bounce: 0,
            origin: zero,
            direction: zero,
            throughput: [1.0; 3],
            transmittance: [1.0; 3],
            distance: None,
            object: None,
            normal: None,
            surface: None,
            emission: None,
            light: None,
            reflection: None,
            radiance: zero,
        }
    }
}
