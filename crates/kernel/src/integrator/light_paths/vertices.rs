//! The vertices of a batch's light paths, for connections.
use super::{
    partial::Partial,
    path_state::{PathVertex, inside},
};
use crate::integrator::{
    queue::Register,
    queues::HitQueues,
    records::{Detail, Hit, MappedNormals, SurfaceCoordinates, Transmittance},
    slots::SLOTS,
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, U, V};
use noisefall_scene::material::Stage;

/// Rows of a vertex.
///
/// | row | content |
/// |---|---|
/// | 0 | position; index of the vertex before in its path plus 1, or 0 |
/// | 1 | normal; number of bounces before it |
/// | 2 | colour; α |
/// | 3 | light that arrives; the error of the position |
/// | 4 | direction to the vertex before; primitive |
/// | 5 | both partial sums, the triangle, and the word of the surface |
/// | 6, 7, 8 | chart and diffuse transmittance |
/// | 9 | shading normal; flags of the relief |
/// | 10, 11 | normals of the relief; handedness of the chart |
const ROWS: u32 = 12;

/// The vertices, each with the place of the one before it in its path.
pub struct LightVertices {
    rows: Vec<[f32; 4]>,
    /// The last vertex of the path of each slot plus 1, or 0.
    last: Vec<[f32; 4]>,
}

impl Default for LightVertices {
    fn default() -> Self {
        LightVertices { rows: Vec::new(), last: vec![[0.0; 4]; SLOTS] }
    }
}

/// Vertices of lights that are connected.
pub struct LightVertex<L: Lanes> {
    pub p: V<L>,
    pub n: V<L>,
    pub bounce: U<L>,
    /// The vertices before them, as in [`LightVertices::last`].
    pub before: U<L>,
    /// The words of their surfaces.
    pub word: U<L>,
}

/// The rest of them.
pub struct LightVertexEnd<L: Lanes> {
    /// Light that arrives.
    pub light: V<L>,
    /// Unit direction to the vertex before.
    pub back: V<L>,
    pub partial: Partial<L>,
    pub primitive: U<L>,
    pub element: U<L>,
}

impl LightVertices {
    pub fn clear(&mut self) {
        self.rows.clear();
        self.last.fill([0.0; 4]);
    }

    /// Stores the vertices in a register of hits. `light` is the light that arrives.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub fn push<L: Lanes>(
        &mut self,
        l: L,
        work: &Work,
        stage: Stage,
        hits: &HitQueues,
        at: Register<L>,
        PathVertex { live, hit, back, partial }: &PathVertex<L>,
        light: V<L>,
        (primitive, element): (U<L>, U<L>),
        bounce: u32,
    ) {
        let zero = l.f(0.0);
        let (mut alpha, mut error, mut word) = (zero, zero, l.u((stage as u32) << noisefall_scene::scene::surface::STAGE_SHIFT));
        let mut shading_n = hit.n;
        // Vertices of the plain stage have no details.
        if stage != Stage::Plain {
            let detail = Detail::read(l, &hits.details, at.start);
            (alpha, error, word, shading_n) = (detail.alpha, detail.error, detail.surface, detail.n);
        }
        let (mut chart, mut handedness) = ([zero; 9], zero);
        if work.scene.surfaces.charted && stage.reads_chart() {
            let SurfaceCoordinates { u, v, along_u, handedness: side, vertex, vertex_opacity } =
                SurfaceCoordinates::read(l, &hits.charts, at.start);
            handedness = side;
            chart = [u, v, along_u.x, along_u.y, along_u.z, vertex.x, vertex.y, vertex.z, vertex_opacity];
        }
        let mut transmitted = V::splat(l, [0.0; 3]);
        if stage.has_transmittance() {
            transmitted = Transmittance::read(l, &hits.transmittances, at.start).colour;
        }
        let mut relief = MappedNormals { smooth: hit.n, tilted_surface: hit.n, flags: l.u(0) };
        if stage != Stage::Plain && !work.scene.surfaces.relief.is_empty() {
            relief = MappedNormals::read(l, &hits.relief, at.start);
        }
        let MappedNormals { smooth, tilted_surface: tilted, flags } = relief;
        let bounce = l.u(bounce).as_real_bits();
        let [a, b, c, d, e, f, g, h, i] = chart;
        let row = |a: F<L>, b: F<L>, c: F<L>, d: F<L>| [a.to_array(), b.to_array(), c.to_array(), d.to_array()];
        let rows = [
            row(hit.p.x, hit.p.y, hit.p.z, zero),
            row(hit.n.x, hit.n.y, hit.n.z, bounce),
            row(hit.colour.x, hit.colour.y, hit.colour.z, alpha),
            row(light.x, light.y, light.z, error),
            row(back.x, back.y, back.z, primitive.as_real_bits()),
            row(partial.v, partial.c, element.as_real_bits(), word.as_real_bits()),
            row(a, b, c, d),
            row(e, f, g, h),
            row(i, transmitted.x, transmitted.y, transmitted.z),
            row(shading_n.x, shading_n.y, shading_n.z, flags.as_real_bits()),
            row(smooth.x, smooth.y, smooth.z, handedness),
            row(tilted.x, tilted.y, tilted.z, zero),
        ];
        let slot = hit.slot.to_array();
        let mut lanes = live.bits();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % MAX_LANES;
            lanes &= lanes - 1;
            let last = &mut self.last[slot[lane] as usize][0];
            let first_row = self.rows.len();
            self.rows.extend(rows.iter().map(|[a, b, c, d]| [a[lane], b[lane], c[lane], d[lane]]));
            self.rows[first_row][3] = *last;
            *last = f32::from_bits(first_row as u32 / ROWS + 1);
        }
    }

    /// The places of all vertices.
    pub fn positions(&self) -> impl Iterator<Item = [f32; 3]> {
        self.rows.iter().step_by(ROWS as usize).map(|[x, y, z, _]| [*x, *y, *z])
    }

    /// The last vertices of the paths in some slots, plus 1, or 0.
    #[inline(always)]
    pub fn last<L: Lanes>(&self, l: L, slot: U<L>) -> U<L> {
        l.rows(&self.last, inside(slot))[0].bits()
    }

    /// Vertices by index.
    #[inline(always)]
    pub fn read<L: Lanes>(&self, l: L, vertex: U<L>) -> LightVertex<L> {
        let row = vertex * ROWS;
        let [x, y, z, before] = l.rows(&self.rows, row);
        let [nx, ny, nz, bounce] = l.rows(&self.rows, row + 1);
        let [.., word] = l.rows(&self.rows, row + 5);
        LightVertex {
            p: V { x, y, z },
            n: V { x: nx, y: ny, z: nz },
            bounce: bounce.bits(),
            before: before.bits(),
            word: word.bits(),
        }
    }

    /// The rest of them.
    #[inline(always)]
    pub fn read_end<L: Lanes>(&self, l: L, vertex: U<L>) -> LightVertexEnd<L> {
        let row = vertex * ROWS;
        let [r, g, b, _] = l.rows(&self.rows, row + 3);
        let [x, y, z, primitive] = l.rows(&self.rows, row + 4);
        let [v, c, element, _] = l.rows(&self.rows, row + 5);
        LightVertexEnd {
            light: V { x: r, y: g, z: b },
            back: V { x, y, z },
            partial: Partial { v, c },
            primitive: primitive.bits(),
            element: element.bits(),
        }
    }

    /// Queues the hits at vertices in the lanes of `keep`, whose stage is `stage`.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub fn queue_hits<L: Lanes>(
        &self,
        l: L,
        work: &Work,
        stage: Stage,
        keep: M<L>,
        vertex: U<L>,
        read: &LightVertex<L>,
        slot: U<L>,
        queues: &mut HitQueues,
    ) {
        let row = vertex * ROWS;
        let [r, g, b, alpha] = l.rows(&self.rows, row + 2);
        let [.., error] = l.rows(&self.rows, row + 3);
        let [x, y, z, _] = l.rows(&self.rows, row + 4);
        let (p, n) = (read.p, read.n);
        let throughput = V::splat(l, [1.0; 3]);
        Hit { p, n, colour: V { x: r, y: g, z: b }, throughput, slot }.push(keep, &mut queues.hits);
        if stage == Stage::Plain {
            return;
        }
        let (none, wo) = (l.u(0), V { x, y, z });
        let [x, y, z, flags] = l.rows(&self.rows, row + 9);
        let n = V { x, y, z };
        if !work.scene.surfaces.relief.is_empty() {
            let ([a, b, c, _], [d, e, f, _]) = (l.rows(&self.rows, row + 10), l.rows(&self.rows, row + 11));
            let (smooth, tilted_surface) = (V { x: a, y: b, z: c }, V { x: d, y: e, z: f });
            MappedNormals { smooth, tilted_surface, flags: flags.bits() }.push(keep, &mut queues.relief);
        }
        Detail { wo, n, alpha, error, surface: read.word, media: none, medium: none }.push(keep, &mut queues.details);
        let (of_chart, more, rest) = (l.rows(&self.rows, row + 6), l.rows(&self.rows, row + 7), l.rows(&self.rows, row + 8));
        if work.scene.surfaces.charted && stage.reads_chart() {
            let ([u, v, x, y], [z, r, g, b], [vertex_opacity, ..]) = (of_chart, more, rest);
            let [.., handedness] = l.rows(&self.rows, row + 10);
            let (along_u, vertex) = (V { x, y, z }, V { x: r, y: g, z: b });
            SurfaceCoordinates { u, v, along_u, handedness, vertex, vertex_opacity }.push(keep, &mut queues.charts);
        }
        if stage.has_transmittance() {
            let [_, x, y, z] = rest;
            Transmittance { colour: V { x, y, z } }.push(keep, &mut queues.transmittances);
        }
    }
}
