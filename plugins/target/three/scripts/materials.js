import { Color, DataTexture, DoubleSide, FloatType, FrontSide, GLSL3, IntType, Matrix4, MeshLambertMaterial, NearestFilter, RawShaderMaterial,
    RedFormat, RGBAFormat, RGBAIntegerFormat, UnsignedShortType, Vector3 } from "three";
import { bytesOf } from "../../../../sdk/web/arrays.js";
import { shadowTexels } from "../../../../sdk/web/shadow_tree.js";
import { levelsOf, sizeWithLevels } from "../../../../sdk/web/texture_levels.js";
import { isTextured } from "./geometry.js";

export const HEADER = "precision highp float;\nprecision highp int;\n";

/** Numbers as an unfiltered texture. */
function dataTexture(array, width, height, format, type, internalFormat) {
    const texture = new DataTexture(array, width, height, format, type);
    Object.assign(texture, { internalFormat, minFilter: NearestFilter, magFilter: NearestFilter, needsUpdate: true });
    return texture;
}

/** `Type`: of the array, in rows of `width` texels, padded. */
function tableTexture(Type, bytes, components, width, ...formats) {
    const numbers = new Type(bytes.buffer), height = Math.max(1, Math.ceil(numbers.length / components / width));
    const texels = new Type(components * width * height);
    texels.set(numbers);
    return dataTexture(texels, width, height, ...formats);
}

/** The maps of lights that highlights mirror; three.js has no textures of three channels. */
function radianceTexture({ texels, width }) {
    const numbers = new Float32Array(bytesOf(texels).buffer), height = Math.ceil(numbers.length / 3 / width);
    const all = new Float32Array(4 * width * height);
    for (let i = 0; i < numbers.length; ++i) all[4 * Math.floor(i / 3) + (i % 3)] = numbers[i];
    return dataTexture(all, width, height, RGBAFormat, FloatType, "RGBA32F");
}

/** The uniforms with which shaders find out whether light is blocked; none in a scene without shadows. */
function shadowUniforms({ shadows, objects, textures, image }) {
    if (!shadows) return {};
    const { height, texels } = shadowTexels(shadows, objects, textures, image.is_srgb);
    return {
        shadow_tree: { value: dataTexture(texels, shadows.width, height, RGBAIntegerFormat, IntType, "RGBA32I") },
        least_margin: { value: shadows.least_margin }, picture_height: { value: image.height },
    };
}

/** Whether something may be seen through an object. */
export const hasLayers = ({ objects }) => objects.some(({ opacity }) => opacity !== undefined);

const opacityUniforms = ({ opacity, opacity_cutoff }) =>
    (opacity === undefined ? {} : { object_opacity: { value: opacity }, object_opacity_cutoff: { value: opacity_cutoff } });

/** A picture's texels, and what shaders know of it. */
function pictureOf(picture, isSrgb) {
    const [width, height] = sizeWithLevels(picture), texels = new Uint16Array(4 * width * height);
    const levels = levelsOf(picture, isSrgb);
    for (const { place: [left, top], width: columns, height: rows, texels: part } of levels) {
        for (let y = 0; y < rows; ++y)
            texels.set(part.subarray(4 * columns * y, 4 * columns * (y + 1)), 4 * (width * (top + y) + left));
    }
    return {
        texels: { value: dataTexture(texels, width, height, RGBAIntegerFormat, UnsignedShortType, "RGBA16UI") },
        size: { width: picture.width, height: picture.height, levels: levels.length },
    };
}

const sideOf = ({ closed }) => (closed ? FrontSide : DoubleSide);

/** Lambert's law by three.js; the material emits the ambient light. */
function lambertMaterial({ lambert: { color, emissive }, mesh, ...object }) {
    return new MeshLambertMaterial({ color: new Color(...color), emissive: new Color(...emissive), vertexColors: mesh.color !== null, side: sideOf(object) });
}

/** Materials whose shaders are made of the formulas of the scene's models. */
export class KernelMaterials {
    constructor(json) {
        this.json = json;
        /** The observer's uniforms, which all materials share. */
        this.seen = {
            view_projection: { value: new Matrix4() }, eye: { value: new Vector3() }, is_orthographic: { value: false },
            towards_observer: { value: new Vector3() }, pixel_right: { value: new Vector3() }, pixel_up: { value: new Vector3() },
            line_of_sight: { value: new Vector3() },
        };
        this.lights = Object.fromEntries(Object.entries(json.light_counts).map(([name, value]) => [name, { value }]));
        this.lights.light_table = { value: tableTexture(Int32Array, bytesOf(json.light_table), 4, json.light_table_width, RGBAIntegerFormat, IntType, "RGBA32I") };
        this.lights.table_numbers = { value: tableTexture(Float32Array, bytesOf(json.tables), 1, json.table_width, RedFormat, FloatType, "R32F") };
        if (json.radiance) this.lights.radiance_texels = { value: radianceTexture(json.radiance) };
        this.shadows = shadowUniforms(json);
        /** The uniforms of the layer that is drawn, in a scene with opacity. */
        this.layer = hasLayers(json) ? { covered: { value: null }, depth_before: { value: null }, is_first_layer: { value: true } } : {};
        this.mostPictures = Math.max(0, ...json.objects.map((object) => object.material_pictures.length));
        this.textures = json.textures.map((picture) => pictureOf(picture, json.image.is_srgb));
    }

    /** The uniforms with which an object's textures are read. */
    textureUniforms({ material_pictures, ...object }) {
        const uniforms = {};
        if (!isTextured(object)) return uniforms;
        // Even a sampler that is not read needs a texture of its type.
        const other = this.textures[0]?.texels;
        for (let i = 0; i < this.mostPictures; ++i) uniforms[`material_texels_${i}`] = other;
        for (const [i, [picture, wrap_u, wrap_v]] of material_pictures.entries()) {
            const { texels, size } = this.textures[picture];
            uniforms[`material_texels_${i}`] = texels;
            uniforms[`material_texture_${i}`] = { value: { ...size, wrap_u, wrap_v, unit: i } };
        }
        return uniforms;
    }

    of(object) {
        const { shaders } = this.json, hasMaterial = object.material !== null;
        const common = HEADER + (object.closed ? "" : "#define TWO_SIDED\n") +
            (hasMaterial ? "#define TEXTURED_MATERIAL\n" : "") + [
            shaders.prelude, isTextured(object) ? shaders.texture : "", shaders.lights, shaders.reflections[object.reflection],
            shaders.shadings[object.shading], hasMaterial ? shaders.materials[object.material] : "",
            object.normal_map !== null ? shaders.normal_maps[object.normal_map] : "",
            object.opacity_map !== null ? shaders.opacities[object.opacity_map] : "", "",
        ].join("\n");
        const uniforms = { ...this.seen, ...this.lights, ...this.shadows, ...this.layer, ...this.textureUniforms(object), ...opacityUniforms(object) };
        for (const [name, value] of Object.entries(object.uniforms)) uniforms[name] = { value };
        return new RawShaderMaterial({
            glslVersion: GLSL3, vertexShader: common + shaders.vertex, fragmentShader: common + shaders.fragment, uniforms, side: sideOf(object),
        });
    }
}

/** three.js's own material if it has the same formula, otherwise one made of the kernels. */
export const materialOf = (object, kernels) => (object.lambert === null ? kernels.of(object) : lambertMaterial(object));
