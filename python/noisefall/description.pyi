"""Dataclasses of the scene format. Made by `python -m noisefall.stubs`; do not edit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

def to_dict(value: Any) -> Any:
    """A tree of dicts and lists without dataclasses and without fields that are `None`."""

@dataclass(kw_only=True)
class Gaussian:
    """A normal distribution, cut off at three standard deviations."""

    sigma: float
    """Standard deviation. (pixels)"""

@dataclass(kw_only=True)
class Tent:
    """Falls linearly from the centre to 0."""

    radius: float
    """Radius of the tent. (pixels)"""

@dataclass(kw_only=True)
class Filter:
    """How a pixel weights the light around its centre. Default: "box"."""

    gaussian: Gaussian | Mapping[str, Any] | None = None
    """A normal distribution, cut off at three standard deviations."""
    tent: Tent | Mapping[str, Any] | None = None
    """Falls linearly from the centre to 0."""

@dataclass(kw_only=True)
class Lens:
    """A thin lens. Default: a pinhole."""

    focus: float
    """Distance of the plane in focus from the eye, along the axis. (m)"""
    radius: float
    """Radius of the lens; 0 is a pinhole. (m)"""

@dataclass(kw_only=True)
class Rotate:
    """Rotation about an axis through the origin."""

    axis: Sequence[float]
    """Direction of the axis, of any length."""
    degrees: float
    """Angle, counter-clockwise when the axis points at the viewer. (°)"""

@dataclass(kw_only=True)
class Motion:
    """An entry of `motion`."""

    matrix: Sequence[Sequence[float]] | None = None
    """Four rows of four numbers; the last row is 0, 0, 0, 1."""
    rotate: Rotate | Mapping[str, Any] | None = None
    """Rotation about an axis through the origin."""
    scale: Sequence[float] | float | None = None
    """Scale factors of x, y and z, or one factor for all."""
    translate: Sequence[float] | None = None
    """Translation. (m)"""

@dataclass(kw_only=True)
class Orthographic:
    """Parallel projection."""

    width: float
    """Width of the image in the scene. (m)"""

@dataclass(kw_only=True)
class Projection:
    """How the scene is projected. Default: "perspective"."""

    orthographic: Orthographic | Mapping[str, Any] | None = None
    """Parallel projection."""

@dataclass(kw_only=True)
class Camera:
    """Position, direction and lens of the camera."""

    eye: Sequence[float]
    """Position of the camera. (m)"""
    filter: Literal['box', 'tent', 'gaussian'] | Filter | Mapping[str, Any] | None = None
    """How a pixel weights the light around its centre. Default: "box"."""
    fov: float | None = None
    """Field of view across the width of the image. Required for a perspective; other projections have none. (°)"""
    lens: Lens | Mapping[str, Any] | None = None
    """A thin lens. Default: a pinhole."""
    look_at: Sequence[float]
    """Point that appears at the centre of the image. (m)"""
    motion: Sequence[Motion | Mapping[str, Any]] | None = None
    """Transforms that move the camera from time 0 to 1."""
    projection: Literal['perspective'] | Projection | Mapping[str, Any] | None = None
    """How the scene is projected. Default: "perspective"."""
    resolution: Sequence[int]
    """Width and height. (pixels)"""
    shift: Sequence[float] | None = None
    """Shift of the image plane to the right and up, in widths of the image. Upright lines stay parallel."""
    shutter: Sequence[float] | None = None
    """Times at which the shutter opens and closes. Motion runs from time 0 to 1. Default: time 0."""
    up: Sequence[float] | None = None
    """Direction that points up in the image. Default: [0, 1, 0]."""

@dataclass(kw_only=True)
class Sky:
    """A clear sky with a sun; black below the horizon."""

    ground_albedo: Sequence[float] | float | None = None
    """Albedo of the ground, which brightens the sky of `hosek`."""
    model: Literal['preetham', 'hosek'] | None = None
    """Model of the radiance."""
    sky_scale: float | None = None
    """Factor that multiplies the radiance of the sky."""
    sun: Sequence[float] | None = None
    """Direction towards the sun, of any length."""
    sun_diameter: float | None = None
    """Angular diameter of the sun. Changing it keeps the irradiance. Default: that of the model. (degrees)"""
    sun_scale: float | None = None
    """Factor that multiplies the radiance of the sun; 0 shows the sky alone."""
    turbidity: float | None = None
    """Haze: 2 is very clear, 10 is hazy."""
    zenith: Sequence[float] | None = None
    """Direction of the zenith, of any length."""

@dataclass(kw_only=True)
class Transform:
    """An entry of `transform`."""

    matrix: Sequence[Sequence[float]] | None = None
    """Four rows of four numbers; the last row is 0, 0, 0, 1."""
    rotate: Rotate | Mapping[str, Any] | None = None
    """Rotation about an axis through the origin."""
    scale: Sequence[float] | float | None = None
    """Scale factors of x, y and z, or one factor for all."""
    translate: Sequence[float] | None = None
    """Translation. (m)"""

@dataclass(kw_only=True)
class Environment:
    """Radiance of rays that meet no surface."""

    image: str | None = None
    """Equirectangular image, such as EXR or HDR; its centre is towards −z."""
    pole_rows: bool | None = None
    """Whether the first and last rows of texels lie at the poles. Otherwise they lie half a row from them."""
    radiance: Sequence[float] | float | None = None
    """Radiance of each channel. (W·sr⁻¹·m⁻²)"""
    rotate: float | None = None
    """Rotation of the image, counter-clockwise seen from above. (°)"""
    scale: float | None = None
    """Factor that multiplies the radiance."""
    sky: Sky | Mapping[str, Any] | None = None
    """A clear sky with a sun; black below the horizon."""
    transform: Sequence[Transform | Mapping[str, Any]] | None = None
    """Rotations and mirrorings of the image, applied after `rotate`."""

@dataclass(kw_only=True)
class Directional:
    """Parallel light, as from a distant sun."""

    direction: Sequence[float] | None = None
    """Direction in which the light travels, of any length."""
    irradiance: Sequence[float] | float | None = None
    """Irradiance of a surface that faces the light. (W·m⁻²)"""

@dataclass(kw_only=True)
class Point:
    """A light without size that shines equally in all directions."""

    intensity: Sequence[float] | float | None = None
    """Radiant intensity of each channel. (W·sr⁻¹)"""
    position: Sequence[float] | None = None
    """Position of the light. (m)"""

@dataclass(kw_only=True)
class Projector:
    """An image that is cast from a point."""

    angle: float | None = None
    """Angle between the axis and the edge of the cone, where the light ends; 180 for no cone. (°)"""
    aspect: float | None = None
    """Width of the image divided by its height; 0 takes that of the file."""
    encoding: Literal['srgb', 'linear'] | None = None
    """Encoding of the file's numbers; EXR, HDR and PFM are always linear."""
    filter: Literal['bilinear', 'nearest'] | None = None
    """Interpolation between texels."""
    flat: bool | None = None
    """Whether a screen that faces the projector is lit evenly. Otherwise the intensity is the same in all directions."""
    fov: float | None = None
    """Angle across the width of the image. (°)"""
    image: str | None = None
    """The image file, relative to the scene; a white square if it is empty."""
    inner: float | None = None
    """Angle up to which the cone does not dim the image. From there to `angle`, the light falls linearly. (°)"""
    position: Sequence[float] | None = None
    """Position of the light. (m)"""
    scale: float | None = None
    """Radiant intensity on the axis where the image is 1. (W·sr⁻¹)"""
    target: Sequence[float] | None = None
    """Point that the light is aimed at. (m)"""
    tint: Sequence[float] | float | None = None
    """Factor that multiplies the colours of the image."""
    up: Sequence[float] | None = None
    """Direction that points up in the image."""
    wrap: Literal['repeat', 'mirror', 'clamp', 'black'] | None = None
    """How the image continues beyond its edges. Texels blend over half their width there."""

@dataclass(kw_only=True)
class Spot:
    """A light without size that shines within a cone."""

    angle: float | None = None
    """Angle between the axis and the edge of the cone, where the light ends. (°)"""
    falloff: Literal['smooth', 'linear', 'square'] | None = None
    """How the intensity falls from `inner` to `angle`."""
    inner: float | None = None
    """Angle up to which the intensity is that of the axis; at most `angle`. (°)"""
    intensity: Sequence[float] | float | None = None
    """Radiant intensity on the axis. (W·sr⁻¹)"""
    position: Sequence[float] | None = None
    """Position of the light. (m)"""
    target: Sequence[float] | None = None
    """Point that the light is aimed at. (m)"""

@dataclass(kw_only=True)
class Light:
    """An entry of `lights`."""

    directional: Directional | Mapping[str, Any] | None = None
    """Parallel light, as from a distant sun."""
    name: str | None = None
    """Name in the window."""
    point: Point | Mapping[str, Any] | None = None
    """A light without size that shines equally in all directions."""
    projector: Projector | Mapping[str, Any] | None = None
    """An image that is cast from a point."""
    spot: Spot | Mapping[str, Any] | None = None
    """A light without size that shines within a cone."""
    transform: Sequence[Transform | Mapping[str, Any]] | None = None
    """Transforms, applied from the first to the last."""

@dataclass(kw_only=True)
class Blend:
    """A mixture of two materials. Each may itself be a blend or `null`."""

    by_side: bool | None = None
    """Whether the front has the first material and the back the second, regardless of the weight."""
    first: str
    """Name of the first material."""
    second: str
    """Name of the second material."""
    weight: float | Mapping[str, str] | None = None
    """Fraction of the second material."""

@dataclass(kw_only=True)
class Bump:
    """Makes the surface look uneven: heights from a texture tilt the shading normal; outlines stay smooth."""

    height: float
    """Height of luminance 1 above luminance 0. (m)"""
    texture: str
    """The name of a texture."""

@dataclass(kw_only=True)
class Conductor:
    """Metal, smooth or rough: microfacets with Fresnel's reflectance."""

    alpha: float | Mapping[str, str] | None = None
    """Width of the distribution of microfacet slopes; 0 is smooth."""
    anisotropy: float | None = None
    """How much longer the highlight is along the tangent ∂p/∂u; 0 is round."""
    distribution: Literal['ggx', 'beckmann'] | None = None
    """Distribution of the microfacets; the light that scatters more than once between Beckmann facets is lost."""
    energy_compensation: bool | None = None
    """Whether to add the light that scatters more than once between microfacets."""
    eta: Sequence[float] | float | None = None
    """Real part of the complex index of refraction."""
    f0: Sequence[float] | float | Mapping[str, str] | None = None
    """Reflectance at normal incidence; it rises to 1 at grazing angles by Schlick's approximation."""
    k: Sequence[float] | float | None = None
    """Imaginary part of the index: how strongly the metal absorbs light."""
    reflectance: Sequence[float] | float | Mapping[str, str] | None = None
    """Reflectance of the microfacets, the same at every angle."""
    roughness: float | Mapping[str, str] | None = None
    """Square root of α; 0 is smooth."""
    tangent_rotation: float | None = None
    """Rotation of the tangent about the normal. (°)"""
    tint: Sequence[float] | float | Mapping[str, str] | None = None
    """Multiplies the reflectance at every angle."""

@dataclass(kw_only=True)
class Dielectric:
    """Glass, water: an interface that reflects and refracts, smooth or rough."""

    alpha: float | Mapping[str, str] | None = None
    """Width of the distribution of microfacet slopes; 0 is smooth."""
    anisotropy: float | None = None
    """How much longer the highlight is along the tangent ∂p/∂u; 0 is round."""
    distribution: Literal['ggx', 'beckmann'] | None = None
    """Distribution of the microfacets; the light that scatters more than once between Beckmann facets is lost."""
    energy_compensation: bool | None = None
    """Whether to add the light that scatters more than once between microfacets."""
    ior: float
    """Index of refraction inside."""
    ior_outside: float | None = None
    """Index of refraction on the side of the normal."""
    roughness: float | Mapping[str, str] | None = None
    """Square root of α; 0 is smooth."""
    specular_reflectance: Sequence[float] | float | Mapping[str, str] | None = None
    """Factor that multiplies the reflected light; 1 is physical."""
    specular_transmittance: Sequence[float] | float | Mapping[str, str] | None = None
    """Factor that multiplies the transmitted light; 1 is physical."""
    tangent_rotation: float | None = None
    """Rotation of the tangent about the normal. (°)"""
    transmittance: Sequence[float] | float | None = None
    """Fraction of the light that one metre of the interior transmits."""

@dataclass(kw_only=True)
class DiffuseTransmission:
    """A thin sheet, such as a leaf or paper, that reflects and transmits diffusely."""

    reflectance: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that is reflected, per channel."""
    transmittance: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that is transmitted, per channel."""

@dataclass(kw_only=True)
class Disney:
    """Disney's principled BSDF, exactly as in Mitsuba; bright, rough surfaces reflect more light than arrives."""

    anisotropic: float | Mapping[str, str] | None = None
    """How much longer the highlight is along the tangent; 0 is round."""
    base_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Albedo of the diffuse base, and reflectance of the metal at normal incidence."""
    clearcoat: float | Mapping[str, str] | None = None
    """Strength of the clear coat. It takes no light from the base."""
    clearcoat_gloss: float | Mapping[str, str] | None = None
    """Sharpness of the clear coat: its facets have a width from 0.1 to 0.001."""
    flatness: float | Mapping[str, str] | None = None
    """How strongly the diffuse lobe resembles thin subsurface scattering."""
    ior: float | None = None
    """Index of refraction. With 1, nothing is reflected, even by metal."""
    metallic: float | Mapping[str, str] | None = None
    """Fraction of the base that is metal."""
    roughness: float | Mapping[str, str] | None = None
    """Square root of the width α of the GGX distribution."""
    sheen: float | Mapping[str, str] | None = None
    """Amount of light that fibres reflect at grazing angles."""
    sheen_tint: float | Mapping[str, str] | None = None
    """How strongly the hue of the base colour tints the sheen."""
    spec_tint: float | Mapping[str, str] | None = None
    """How strongly the hue of the base colour tints the reflection off the interface."""
    spec_trans: float | Mapping[str, str] | None = None
    """Fraction of the non-metallic base that is clear and refracts."""

@dataclass(kw_only=True)
class Lambertian:
    """Ideal diffuse reflection: the same radiance in all directions."""

    albedo: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that is reflected, per channel."""

@dataclass(kw_only=True)
class Mirror:
    """A smooth mirror."""

    reflectance: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that is reflected, the same at every angle."""

@dataclass(kw_only=True)
class Null:
    """A surface that light passes unchanged."""


@dataclass(kw_only=True)
class Plastic:
    """A diffuse base under a clear coat, smooth or rough."""

    albedo: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that the base reflects, without its coat."""
    alpha: float | Mapping[str, str] | None = None
    """Width of the distribution of microfacet slopes; 0 is smooth."""
    ior: float
    """Index of refraction of the coat."""
    roughness: float | Mapping[str, str] | None = None
    """Square root of α; 0 is smooth."""

@dataclass(kw_only=True)
class Principled:
    """OpenPBR Surface: diffuse base, metal or glass, with coat, fuzz and thin film."""

    base_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Albedo of the diffuse base, and reflectance of the metal at normal incidence."""
    base_diffuse_roughness: float | Mapping[str, str] | None = None
    """Roughness of the diffuse base; 0 is Lambertian."""
    base_metalness: float | Mapping[str, str] | None = None
    """Fraction of the base that is metal."""
    base_weight: float | Mapping[str, str] | None = None
    """Factor that multiplies the base colour."""
    coat_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Fraction of the light that the coat transmits, in and out."""
    coat_darkening: float | Mapping[str, str] | None = None
    """How much reflections inside the coat darken the base."""
    coat_ior: float | None = None
    """Index of refraction of the coat."""
    coat_roughness: float | Mapping[str, str] | None = None
    """Square root of the width α of the coat."""
    coat_roughness_anisotropy: float | Mapping[str, str] | None = None
    """Anisotropy of the coat; 0 is round."""
    coat_weight: float | Mapping[str, str] | None = None
    """Fraction of the surface under a clear coat."""
    fuzz_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Albedo of the fuzz."""
    fuzz_roughness: float | Mapping[str, str] | None = None
    """Roughness of the fuzz."""
    fuzz_weight: float | Mapping[str, str] | None = None
    """Fraction of the surface under fuzz."""
    specular_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Tint of the reflection off the interface; for metals, only at grazing angles."""
    specular_ior: float | None = None
    """Index of refraction of the base."""
    specular_roughness: float | Mapping[str, str] | None = None
    """Square root of the width α of the GGX distribution."""
    specular_roughness_anisotropy: float | Mapping[str, str] | None = None
    """How much longer the highlight is along the tangent; 0 is round."""
    specular_weight: float | Mapping[str, str] | None = None
    """Factor that multiplies the reflectance of the interface; for metals, also at grazing angles."""
    tangent_rotation: float | None = None
    """Rotation of the tangent about the normal. (°)"""
    thin_film_ior: float | None = None
    """Index of refraction of the film."""
    thin_film_thickness: float | Mapping[str, str] | None = None
    """Thickness of the film. (µm)"""
    thin_film_weight: float | Mapping[str, str] | None = None
    """Fraction of the surface with a thin film."""
    thin_walled: bool | None = None
    """Whether the surface is a thin sheet, which refracts nothing."""
    transmission_color: Sequence[float] | float | Mapping[str, str] | None = None
    """Colour of the transmitted light, at each interface or after `transmission_depth`."""
    transmission_depth: float | None = None
    """Distance inside after which light has the colour of transmission; 0 tints at the interface. (m)"""
    transmission_weight: float | Mapping[str, str] | None = None
    """Fraction of the non-metallic base that is clear and refracts."""

@dataclass(kw_only=True)
class RoughPlastic:
    """A diffuse base under a clear coat whose facets scatter light once, as in Mitsuba."""

    albedo: Sequence[float] | float | Mapping[str, str]
    """Fraction of the light that the base reflects, without its coat."""
    alpha: float | Mapping[str, str] | None = None
    """Width of the distribution of microfacet slopes; 0 is smooth."""
    distribution: Literal['ggx', 'beckmann'] | None = None
    """Distribution of the microfacets."""
    internal_reflectance: float | None = None
    """Fraction of the light from the base that the coat reflects back to it, at most that of a smooth coat."""
    ior: float
    """Index of refraction of the coat."""
    nonlinear: bool | None = None
    """Whether reflections between base and coat make the colour more saturated."""
    roughness: float | Mapping[str, str] | None = None
    """Square root of α; 0 is smooth."""
    specular_reflectance: Sequence[float] | float | None = None
    """Factor that multiplies the reflected light; 1 is physical."""

@dataclass(kw_only=True)
class ThinDielectric:
    """A thin pane of glass: reflects and transmits without refraction."""

    ior: float
    """Index of refraction of the pane relative to its surroundings."""
    specular_reflectance: Sequence[float] | float | None = None
    """Factor that multiplies the reflected light; 1 is physical."""
    specular_transmittance: Sequence[float] | float | None = None
    """Factor that multiplies the transmitted light; 1 is physical."""
    transmittance: Sequence[float] | float | None = None
    """Fraction of the light that the inside of the pane transmits at normal incidence."""

@dataclass(kw_only=True)
class Material:
    """An entry of `materials`."""

    blend: Blend | Mapping[str, Any] | None = None
    """A mixture of two materials. Each may itself be a blend or `null`."""
    bump: Bump | Mapping[str, Any] | None = None
    """Makes the surface look uneven: heights from a texture tilt the shading normal; outlines stay smooth."""
    conductor: Conductor | Mapping[str, Any] | None = None
    """Metal, smooth or rough: microfacets with Fresnel's reflectance."""
    dielectric: Dielectric | Mapping[str, Any] | None = None
    """Glass, water: an interface that reflects and refracts, smooth or rough."""
    diffuse_transmission: DiffuseTransmission | Mapping[str, Any] | None = None
    """A thin sheet, such as a leaf or paper, that reflects and transmits diffusely."""
    disney: Disney | Mapping[str, Any] | None = None
    """Disney's principled BSDF, exactly as in Mitsuba; bright, rough surfaces reflect more light than arrives."""
    lambertian: Lambertian | Mapping[str, Any] | None = None
    """Ideal diffuse reflection: the same radiance in all directions."""
    mirror: Mirror | Mapping[str, Any] | None = None
    """A smooth mirror."""
    mirrored_normals: bool | None = None
    """Whether mapped normals that face away from the viewer are mirrored at the normal of the surface. Otherwise that normal replaces them. Default: false."""
    normal_map: str | None = None
    """A linear image of shading normals."""
    normal_shadowing: bool | None = None
    """Whether bump and normal maps darken light at grazing angles, as microfacets do. This softens hard edges of shading, and makes the surface not reciprocal. Default: false."""
    null: Null | Mapping[str, Any] | None = None
    """A surface that light passes unchanged."""
    opacity: float | Mapping[str, str] | None = None
    """Fraction of the light that meets the surface; the rest passes unchanged. Default: 1."""
    plastic: Plastic | Mapping[str, Any] | None = None
    """A diffuse base under a clear coat, smooth or rough."""
    principled: Principled | Mapping[str, Any] | None = None
    """OpenPBR Surface: diffuse base, metal or glass, with coat, fuzz and thin film."""
    rough_plastic: RoughPlastic | Mapping[str, Any] | None = None
    """A diffuse base under a clear coat whose facets scatter light once, as in Mitsuba."""
    thin_dielectric: ThinDielectric | Mapping[str, Any] | None = None
    """A thin pane of glass: reflects and transmits without refraction."""
    two_sided: bool | None = None
    """Whether the back reflects too. Default: true."""
    two_sided_relief: bool | None = None
    """Whether bump and normal maps look the same from both sides. Otherwise bumps of the front are dents of the back. Default: false."""

@dataclass(kw_only=True)
class Emission:
    """Light that the surface emits."""

    radiance: Sequence[float] | float | None = None
    """Radiance of each channel. (W·sr⁻¹·m⁻²)"""
    scale: float | None = None
    """Factor that multiplies the radiance."""
    texture: str | None = None
    """The name of a texture."""
    two_sided: bool | None = None
    """Whether the back emits too."""

@dataclass(kw_only=True)
class Cuboid:
    """A box with edges along the axes."""

    max: Sequence[float]
    """Corner with the largest coordinates. (m)"""
    min: Sequence[float]
    """Corner with the smallest coordinates. (m)"""

@dataclass(kw_only=True)
class Cylinder:
    """A circular cylinder between two points."""

    base: Sequence[float]
    """Centre of one end. (m)"""
    capped: bool | None = None
    """Whether disks close the ends."""
    radius: float
    """Radius. (m)"""
    top: Sequence[float]
    """Centre of the other end. (m)"""

@dataclass(kw_only=True)
class Disk:
    """A flat disk."""

    center: Sequence[float]
    """Centre. (m)"""
    normal: Sequence[float]
    """Normal of the front, of any length."""
    radius: float
    """Radius. (m)"""

@dataclass(kw_only=True)
class Bounds:
    """Bounding box."""

    max: Sequence[float]
    """Corner with the largest coordinates. (m)"""
    min: Sequence[float]
    """Corner with the smallest coordinates. (m)"""

@dataclass(kw_only=True)
class Isosurface:
    """The surface where an expression is zero. The expression is negative inside."""

    bounds: Bounds | Mapping[str, Any]
    """Bounding box."""
    expression: str
    """Expression in x, y and z, in metres."""

@dataclass(kw_only=True)
class Heightfield:
    """Hills of noise over x and z from −1 to 1."""

    quads: int
    """Quads along each side, of two triangles each."""
    seed: int | None = None
    """Random seed of the hills."""

@dataclass(kw_only=True)
class Knot:
    """A torus knot."""

    triangles: int
    """Approximate number of triangles."""

@dataclass(kw_only=True)
class Mesh:
    """Triangles from a file, from lists, or procedural."""

    heightfield: Heightfield | Mapping[str, Any] | None = None
    """Hills of noise over x and z from −1 to 1."""
    knot: Knot | Mapping[str, Any] | None = None
    """A torus knot."""
    path: str | None = None
    """OBJ, PLY or STL file."""
    smooth: bool | None = None
    """Whether to interpolate normals over the triangles. Default: as the file states; false for lists."""
    triangles: Sequence[Sequence[int]] | None = None
    """Three vertex indices per triangle, counted from 0."""
    vertices: Sequence[Sequence[float]] | None = None
    """Corners of the triangles. (m)"""

@dataclass(kw_only=True)
class Rectangle:
    """A parallelogram, given by a corner and two edges."""

    edge_u: Sequence[float]
    """Edge from that corner to the corner where u = 1. (m)"""
    edge_v: Sequence[float]
    """Edge from that corner to the corner where v = 1. The front is the side of u × v. (m)"""
    origin: Sequence[float]
    """The corner where u = v = 0. (m)"""

@dataclass(kw_only=True)
class Sphere:
    """A sphere; non-uniform scaling makes an ellipsoid."""

    center: Sequence[float]
    """Centre. (m)"""
    radius: float
    """Radius. (m)"""

@dataclass(kw_only=True)
class SphereField:
    """Many spheres at random positions, each a separate object."""

    bounds: Bounds | Mapping[str, Any]
    """Bounding box."""
    count: int
    """Number of spheres."""
    seed: int | None = None
    """Random seed of the positions."""

@dataclass(kw_only=True)
class Triangle:
    """A triangle, given by its corners."""

    a: Sequence[float]
    """The corner where u = v = 0. (m)"""
    b: Sequence[float]
    """The corner where u = 1. (m)"""
    c: Sequence[float]
    """The corner where v = 1. (m)"""

@dataclass(kw_only=True)
class Shape:
    """Shape of the object."""

    cuboid: Cuboid | Mapping[str, Any] | None = None
    """A box with edges along the axes."""
    cylinder: Cylinder | Mapping[str, Any] | None = None
    """A circular cylinder between two points."""
    disk: Disk | Mapping[str, Any] | None = None
    """A flat disk."""
    isosurface: Isosurface | Mapping[str, Any] | None = None
    """The surface where an expression is zero. The expression is negative inside."""
    mesh: Mesh | Mapping[str, Any] | None = None
    """Triangles from a file, from lists, or procedural."""
    rectangle: Rectangle | Mapping[str, Any] | None = None
    """A parallelogram, given by a corner and two edges."""
    sphere: Sphere | Mapping[str, Any] | None = None
    """A sphere; non-uniform scaling makes an ellipsoid."""
    sphere_field: SphereField | Mapping[str, Any] | None = None
    """Many spheres at random positions, each a separate object."""
    triangle: Triangle | Mapping[str, Any] | None = None
    """A triangle, given by its corners."""

@dataclass(kw_only=True)
class Object:
    """An entry of `objects`."""

    emission: Emission | Mapping[str, Any] | None = None
    """Light that the surface emits."""
    flip: bool | None = None
    """Whether to reverse the normal."""
    material: str | None = None
    """Name of the material. Default: black."""
    motion: Sequence[Motion | Mapping[str, Any]] | None = None
    """Transforms that move the object from time 0 to 1."""
    name: str | None = None
    """Name in the window."""
    shape: Shape | Mapping[str, Any]
    """Shape of the object."""
    transform: Sequence[Transform | Mapping[str, Any]] | None = None
    """Transforms, applied from the first to the last."""

@dataclass(kw_only=True)
class Reference:
    """Image or radiance that the render must converge to, if it is known."""

    image: str | None = None
    """Reference image, of the resolution of the camera."""
    radiance: Sequence[float] | float | None = None
    """Radiance of each channel. (W·sr⁻¹·m⁻²)"""

@dataclass(kw_only=True)
class Throughput:
    """Survival probability is the square root of the throughput's largest component, at most 0.95: paths that carry little end early."""

    start: int | None = None
    """The first bounce at which a path can end."""

@dataclass(kw_only=True)
class Roulette:
    """Ends paths at random and weights the survivors, so that the mean does not change."""

    fixed: float | None = None
    """Survival probability at every bounce."""
    throughput: Throughput | Mapping[str, Any] | None = None
    """Survival probability is the square root of the throughput's largest component, at most 0.95: paths that carry little end early."""

@dataclass(kw_only=True)
class Render:
    """The settings that the scene opens with."""

    adaptive: bool | None = None
    """Whether noisy blocks get more samples. Has no effect with path reuse or light paths."""
    count_crossings: bool | None = None
    """Whether passing a surface that is not opaque counts as a bounce for `max_bounces`."""
    directions: Literal['uniform', 'cosine', 'bsdf'] | None = None
    """How the next direction is sampled at diffuse surfaces."""
    estimator: Literal['path', 'light', 'mis', 'caustics', 'light_tracing', 'bidirectional', 'auto'] | None = None
    """How light is estimated. All estimators converge to the same image; they differ in noise."""
    exposure: float | None = None
    """Exposure of the displayed image. One stop doubles the brightness; samples do not change. (stops)"""
    max_bounces: int | None = None
    """Highest number of bounces, reflections and refractions alike. A cap cuts the series L_e + T L_e + …, so the image is too dark. Default: no cap; a path that reaches bounce 4096 is then cut, and the image is labelled biased. (bounces)"""
    merging: bool | None = None
    """Whether the estimator `bidirectional` merges vertices that are near each other (Georgiev et al. 2012). Finds caustics in mirrors. Biased, but consistent."""
    reuse: Literal['auto', 'suffixes', 'outliers', 'both', 'off'] | None = None
    """Path reuse between neighbouring pixels: suffixes (Bekaert, Sbert and Halton 2002), outliers, or both. Less noise, no bias, but the noise of neighbouring pixels is correlated."""
    roulette: Literal['off', 'throughput'] | Roulette | Mapping[str, Any] | None = None
    """Ends paths at random and weights the survivors, so that the mean does not change."""
    sampler: Literal['independent', 'stratified', 'sobol', 'bluenoise'] | None = None
    """Sample pattern of a pixel. It determines how fast the error falls."""
    seed: int | None = None
    """Seed of the random numbers. Another seed gives different noise with the same mean."""
    spp: int | None = None
    """Samples per pixel at which the render stops. Default: no limit."""

@dataclass(kw_only=True)
class Checker:
    """Alternating squares of two colours over u and v."""

    even: Sequence[float] | float | Mapping[str, str]
    """Colour of the square at u = v = 0 and of every second one."""
    odd: Sequence[float] | float | Mapping[str, str]
    """Colour of the other squares."""
    scale: float
    """Squares along each side of the unit square."""

@dataclass(kw_only=True)
class Image:
    """An image over the unit square of u and v."""

    channel: Literal['rgb', 'red', 'green', 'blue', 'alpha'] | None = None
    """The channels that are used."""
    encoding: Literal['srgb', 'linear'] | None = None
    """Encoding of the file's numbers; EXR, HDR and PFM are always linear."""
    filter: Literal['bilinear', 'nearest'] | None = None
    """Interpolation between texels."""
    offset: Sequence[float] | None = None
    """Offset that is added to u and v, applied last."""
    path: str
    """PNG, JPEG, TGA, WebP, BMP, EXR, HDR or PFM file."""
    rotate: float | None = None
    """Rotation from u towards v, applied after the shear. (°)"""
    scale: Sequence[float] | None = None
    """Factors that multiply u and v, applied first. v points downwards."""
    shear: float | None = None
    """Multiple of v that is added to u, applied after the scale."""
    wrap_u: Literal['repeat', 'mirror', 'clamp', 'black'] | None = None
    """How the image continues beyond 0 and 1 in u."""
    wrap_v: Literal['repeat', 'mirror', 'clamp', 'black'] | None = None
    """How the image continues beyond 0 and 1 in v."""

@dataclass(kw_only=True)
class Mix:
    """A mixture of two colours or textures."""

    a: Sequence[float] | float | Mapping[str, str]
    """Colour where the weight is 0."""
    b: Sequence[float] | float | Mapping[str, str]
    """Colour where the weight is 1."""
    weight: float | Mapping[str, str] | None = None
    """Fraction of the second colour; a texture counts by its luminance."""

@dataclass(kw_only=True)
class Noise:
    """Perlin noise in world space, between two colours."""

    high: Sequence[float] | float
    """The colour at 1."""
    low: Sequence[float] | float
    """The colour at 0."""
    octaves: int
    """Layers of noise, each of twice the frequency and half the amplitude."""
    scale: float
    """Cells of the first octave per metre. (m⁻¹)"""

@dataclass(kw_only=True)
class Product:
    """The product of two colours or textures."""

    a: Sequence[float] | float | Mapping[str, str]
    """First factor."""
    b: Sequence[float] | float | Mapping[str, str]
    """Second factor."""

@dataclass(kw_only=True)
class Stop:
    """An entry of `stops`."""

    at: float
    """Position on the scale."""
    color: Sequence[float] | float
    """The colour there."""

@dataclass(kw_only=True)
class Ramp:
    """Colours along a scale, interpolated between stops."""

    input: float | Mapping[str, str]
    """Position on the scale; a texture counts by its luminance."""
    stops: Sequence[Stop | Mapping[str, Any]] | None = None
    """Colours by position, in ascending order."""

@dataclass(kw_only=True)
class VertexColor:
    """The colours of a mesh’s vertices, interpolated; white without them."""

    channel: Literal['rgb', 'red', 'green', 'blue', 'alpha'] | None = None
    """The channels that are used."""

@dataclass(kw_only=True)
class Texture:
    """An entry of `textures`."""

    checker: Checker | Mapping[str, Any] | None = None
    """Alternating squares of two colours over u and v."""
    image: Image | Mapping[str, Any] | None = None
    """An image over the unit square of u and v."""
    mix: Mix | Mapping[str, Any] | None = None
    """A mixture of two colours or textures."""
    noise: Noise | Mapping[str, Any] | None = None
    """Perlin noise in world space, between two colours."""
    product: Product | Mapping[str, Any] | None = None
    """The product of two colours or textures."""
    ramp: Ramp | Mapping[str, Any] | None = None
    """Colours along a scale, interpolated between stops."""
    vertex_color: VertexColor | Mapping[str, Any] | None = None
    """The colours of a mesh’s vertices, interpolated; white without them."""

@dataclass(kw_only=True)
class Description:
    """A scene file."""

    camera: Camera | Mapping[str, Any]
    """Position, direction and lens of the camera."""
    environment: Environment | Mapping[str, Any] | None = None
    """Radiance of rays that meet no surface."""
    format: int | None = None
    """The version of the format: 1."""
    lights: Sequence[Light | Mapping[str, Any]] | None = None
    """Punctual lights, one table each."""
    materials: Mapping[str, Material | Mapping[str, Any]] | None = None
    """Materials by name."""
    notes: str | None = None
    """Notes about the scene."""
    objects: Sequence[Object | Mapping[str, Any]] | None = None
    """The objects of the scene, one table each."""
    reference: Reference | Mapping[str, Any] | None = None
    """Image or radiance that the render must converge to, if it is known."""
    render: Render | Mapping[str, Any] | None = None
    """The settings that the scene opens with."""
    textures: Mapping[str, Texture | Mapping[str, Any]] | None = None
    """Textures by name."""
    title: str | None = None
    """Name of the scene in the window and in reports."""
