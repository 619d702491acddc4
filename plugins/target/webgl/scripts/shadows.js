import { blockedPart, shadowTexels } from "../../../../sdk/web/shadow_tree.js";
import { DataTexture } from "./data_texture.js";

/** The triangles that block light and the boxes around them, on the GPU. */
export class Shadows extends DataTexture {
    constructor(gl, scene) {
        const { width } = scene.shadows, { height, texels, trianglesOf } = shadowTexels(scene.shadows, scene.objects, scene.textures, scene.image.color_management === "srgb");
        super(gl, gl.RGBA32I, width, height, "This device's graphics do not have room for the shadows of this many triangles.");
        this.fill(gl.RGBA_INTEGER, gl.INT, texels);
        Object.assign(this, { margin: scene.shadows.least_margin, key: Shadows.keyOf(scene), texels, trianglesOf });
        this.opacities = scene.objects.map(({ opacity }) => opacity);
    }

    /** Makes objects block light by these opacities, where no picture gives them. */
    setOpacities(objects) {
        const floats = new Float32Array(this.texels.buffer), changed = objects.flatMap(({ opacity }, i) => (opacity === this.opacities[i] ? [] : [i]));
        for (const i of changed) {
            this.opacities[i] = objects[i].opacity;
            for (const triangle of this.trianglesOf[i]) if (triangle !== null) floats[4 * triangle + 7] = blockedPart({ opacity: this.opacities[i] });
        }
        if (changed.length > 0) this.fill(this.gl.RGBA_INTEGER, this.gl.INT, this.texels);
    }

    /** Equal for scenes whose shadows are the same for a renderer. */
    static keyOf({ shadows, objects, textures, image }) {
        const opacityOf = ({ mesh, opacity, opacity_cutoff, opacity_channel: channel, shadow_opacity: use }) =>
            [opacity, opacity_cutoff, ...(use ? [use, channel, textures[use.picture?.texture], mesh.uv, mesh.channels] : [])];
        return JSON.stringify([shadows, image.color_management, objects.map((object) => [object.mesh.position, object.mesh.indices, object.is_solid, opacityOf(object)])]);
    }

    isOf(scene) {
        return this.key === Shadows.keyOf(scene);
    }

    /** Binds the texture to a unit; returns the uniforms with which it is read. */
    bind(unit) {
        this.bindTo(unit);
        return { shadow_tree: { kind: "int", value: unit }, least_margin: { kind: "float", value: this.margin } };
    }
}
