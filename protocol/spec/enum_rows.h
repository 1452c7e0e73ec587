#pragma once

#include "protocol/fields/fields.h"
#include "protocol/spec/frame_spec.h"

/// The spelling of every enum that a frame's specification can hold.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<LightType>{
    spelling<LightType::directional>("parallel light from far away, like the sun"),
    spelling<LightType::spot>("from a point, within a cone"),
    spelling<LightType::point>("from a point, in all directions"),
};

template <>
inline constexpr std::array kSpellings<ShadowTechnique>{
    spelling<ShadowTechnique::auto_>(
        "for each light rayTraced where that is estimated to cost at most twice its map, else shadowMap"),
    spelling<ShadowTechnique::shadowMap>(
        "depths seen from the light, filtered: fast, and as exact as its texels are fine"),
    spelling<ShadowTechnique::shadowVolume>(
        "stencilled shadow volumes: exact and sharp, drawn by the device `gl` alone"),
    spelling<ShadowTechnique::rayTraced>("rays for every pixel: exact, and soft where the light has a size"),
    spelling<ShadowTechnique::lightMap>("rays for every texel of the scene's surfaces, once, and a lookup in each "
                                        "frame: soft where the light has a size, for static scenes"),
};

template <>
inline constexpr std::array kRetiredWords<ShadowTechnique>{RetiredWord{"hybrid", "rayTraced"}};

template <>
inline constexpr std::array kSpellings<ShadowSize>{
    spelling<ShadowSize::XSmall>("an eighth of atlas.baseSize"),
    spelling<ShadowSize::Small>("a quarter of atlas.baseSize"),
    spelling<ShadowSize::Medium>("half of atlas.baseSize"),
    spelling<ShadowSize::Large>("atlas.baseSize"),
    spelling<ShadowSize::XLarge>("twice atlas.baseSize"),
};

template <>
inline constexpr std::array kSpellings<ShadowLightPolicy>{
    spelling<ShadowLightPolicy::all>("every light whose shadow is enabled"),
    spelling<ShadowLightPolicy::first>("the first directional light alone"),
};

template <>
inline constexpr std::array kSpellings<ShadowImportance>{
    spelling<ShadowImportance::low>("a quarter of the tile's side"),
    spelling<ShadowImportance::medium>("half of the tile's side"),
    spelling<ShadowImportance::high>("the full side"),
};

template <>
inline constexpr std::array kSpellings<PartitionMode>{
    spelling<PartitionMode::manual>("at the distances of `splits`"),
    spelling<PartitionMode::uniform>("into equal lengths"),
    spelling<PartitionMode::logarithmic>("into equal ratios, mixed with equal lengths by `pssmFactor`"),
};

template <>
inline constexpr std::array kSpellings<DepthRangeMode>{
    spelling<DepthRangeMode::automatic>("from the nearest to the farthest surface in this frame"),
    spelling<DepthRangeMode::manual>("from `min` to `max`"),
};

template <>
inline constexpr std::array kSpellings<Stabilization>{
    spelling<Stabilization::none>("the tightest fit; sharpest for single pictures"),
    spelling<Stabilization::projectionSnapping>("tiles fitted to a sphere and moved by whole texels"),
    spelling<Stabilization::viewSnapping>("tiles fitted to a sphere whose centre lies on a grid in the world"),
};

template <>
inline constexpr std::array kSpellings<FilterType>{
    spelling<FilterType::hard>("one sample, a sharp edge"),
    spelling<FilterType::pcf>("percentage-closer filtering over `size` x `size` texels, or over a disc"),
    spelling<FilterType::vsm>("variance shadow map, blurred"),
    spelling<FilterType::evsm>("exponential variance shadow map, blurred: leaks less light"),
    spelling<FilterType::msm>("moment shadow map of four moments, blurred: leaks less light"),
    spelling<FilterType::pcss>("percentage-closer soft shadows: sharp at the caster's foot, the softer the farther the "
                               "caster, from the light's `angularDiameterDegrees` or `radius`"),
};

template <>
inline constexpr std::array kSpellings<BiasMode>{
    spelling<BiasMode::automatic>("from the texels' size, the filter and the slope: nothing to tune"),
    spelling<BiasMode::manual>("by `depth`, `slope` and `normalOffsetScale`"),
};

template <>
inline constexpr std::array kSpellings<BlendedCasters>{
    spelling<BlendedCasters::dither>("by a 4 x 4 pattern that blocks as much light as their alpha says"),
    spelling<BlendedCasters::threshold>("where their alpha is at least a half"),
};

template <>
inline constexpr std::array kSpellings<Terminator>{
    spelling<Terminator::smooth>("the curved surface that the normals of vertices show"),
    spelling<Terminator::flat>("the triangles, which end the light along their edges"),
};

template <>
inline constexpr std::array kSpellings<View>{
    spelling<View::color>("the shaded scene"),
    spelling<View::depth>("distance along the view axis: metres in EXR, near-to-far grey in PNG"),
    spelling<View::normal>("world-space shading normal: -1..1 in EXR, 0..1 in PNG"),
    spelling<View::cascades>("the shaded scene tinted by cascade: green, blue, purple, red and on; grey without tiles"),
    spelling<View::shadow>("the share of `debug.light` that arrives, 0..1; 1 where it casts no shadow"),
    spelling<View::atlas>(
        "the shadow atlas at its own size: grey with tiles outlined and named light.tile, or raw depth"),
    spelling<View::tile>("the depths of one tile, `debug.tile` of `debug.light`, at its own size"),
    spelling<View::texelGrid>(
        "the shaded scene with the texels of `debug.light` as a checkerboard; grey without tiles"),
    spelling<View::texelDensity>(
        "most pixels that a texel of `debug.light` spans: a heat map (1/16 to 16), or numbers; 0 = no texel"),
    spelling<View::blendWeight>("weight of the next cascade of `debug.light`, 0..1; 0 = none"),
    spelling<View::bias>(
        "metres by which a point is moved for `debug.light`: a heat map (0.1 mm to 1 m), or numbers; 0 = no tile"),
    spelling<View::casterIds>(
        "the node that casts the shadow of `debug.light`: a color, or its index; grey, or -1, where none does"),
    spelling<View::lightContribution>(
        "the scene lit by `debug.light` alone: no other light, surroundings, emission or background"),
    spelling<View::reference>(
        "the share of `debug.light` that rays find at each pixel; 1 where nothing receives its shadow"),
    spelling<View::error>("false shadow of `debug.light` in red, false light in blue; or shadow minus reference"),
    spelling<View::edgeDistance>("pixels from each edge of the shadow of `debug.light` to the nearest exact one: a "
                                 "heat map (0 to 16), or numbers; -1 = no edge"),
    spelling<View::ids>("the node that is seen: a color for each, or its index; black, or -1, where none is"),
    spelling<View::instances>(
        "the copy of that node's mesh (EXT_mesh_gpu_instancing), 0 where there is but one; as `ids`"),
    spelling<View::materials>("the material that is seen, as `ids`; -1 also where a surface has none in the file"),
    spelling<View::albedo>("the base color of what is seen, unlit; black where nothing is"),
    spelling<View::position>("the point that is seen, in the world: metres, infinity where none is; or its place in "
                             "the scene's bounds as a color"),
    spelling<View::motion>(
        "pixels that what is seen has moved in the picture since `motionFrom`: x to the right, y down, infinity where "
        "nothing is or was not before the camera then; or the direction as a hue, the stronger the farther"),
    spelling<View::sunHours>("hours of direct sun in the time of `sunHours`: a heat map (0 to all hours of daylight) "
                             "with a scale, or numbers; black, or -1, where no surface is"),
};

template <>
inline constexpr std::array kSpellings<ImageFormat>{
    spelling<ImageFormat::png>("8 bits a channel, sRGB; 16 bits by `pngBits`"),
    spelling<ImageFormat::exr>("linear light, every view a named layer"),
    spelling<ImageFormat::npy>("an array for NumPy: rows, columns and, of several, channels"),
    spelling<ImageFormat::npz>("every view as an array for NumPy, and the report, in one ZIP"),
    spelling<ImageFormat::tiff>("the numbers of an EXR, 32 bits a channel, of one view"),
    spelling<ImageFormat::jpeg>("small, for previews: neither exact nor transparent"),
    spelling<ImageFormat::webp>("smaller still, for previews: not exact"),
};

template <>
inline constexpr std::array kSpellings<ArrayColors>{
    spelling<ArrayColors::srgb>("bytes as in a PNG, exposed and tone mapped"),
    spelling<ArrayColors::linear>("32-bit floats as in an EXR, linear and not tone mapped"),
};

template <>
inline constexpr std::array kSpellings<CameraAxes>{
    spelling<CameraAxes::opengl>("x right, y up, the camera looks along -z: OpenGL, glTF, Blender"),
    spelling<CameraAxes::opencv>("x right, y down, the camera looks along z: OpenCV, ROS, COLMAP"),
};

template <>
inline constexpr std::array kSpellings<ExrCompression>{
    spelling<ExrCompression::none>("fastest to write, largest"),
    spelling<ExrCompression::rle>("run lengths"),
    spelling<ExrCompression::zip>("deflate, 16 rows at a time"),
    spelling<ExrCompression::piz>("wavelets, small for noisy pictures"),
};

template <>
inline constexpr std::array kSpellings<ExrPixelType>{
    spelling<ExrPixelType::half>("16 bits"),
    spelling<ExrPixelType::float_>("32 bits"),
};

template <>
inline constexpr std::array kSpellings<ToneMapping>{
    spelling<ToneMapping::aces>("a film-like curve"),
    spelling<ToneMapping::neutral>("Khronos PBR Neutral: colors of surfaces stay, highlights alone are compressed"),
    spelling<ToneMapping::agx>("AgX: soft contrast, bright colors fade to white"),
    spelling<ToneMapping::none>("unchanged, clipped at 1"),
};

template <>
inline constexpr std::array kSpellings<DeviceChoice>{
    spelling<DeviceChoice::auto_>("OpenGL on a GPU, or else the processor"),
    spelling<DeviceChoice::cpu>("the processor alone"),
    spelling<DeviceChoice::gl>("OpenGL, by whatever driver there is"),
};

template <>
inline constexpr std::array kSpellings<Antialiasing>{
    spelling<Antialiasing::none>("one sample a pixel"),
    spelling<Antialiasing::msaa4x>("four samples a pixel"),
};

} // namespace gnomon
