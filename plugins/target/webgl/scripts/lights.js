import { DataTexture } from "./data_texture.js";

/** The lights' parameters for shaders: a texture with a texel for each, as bits. */
export class LightTable extends DataTexture {
    constructor(gl, scene) {
        const blocks = Object.values(scene.light_models).map(({ block }) => block);
        const total = blocks.reduce((sum, { lights, texels }) => sum + lights * texels, 0);
        const height = Math.max(1, Math.ceil(total / scene.light_table_width));
        super(gl, gl.RGBA32I, scene.light_table_width, height, "This device's graphics do not have room for this many lights.");
        this.models = scene.light_models;
    }

    /** Binds the table, filled with an appearance's lights, to a texture unit; returns the uniforms with which they are read. */
    bind(unit, lights) {
        if (this.lights !== lights) this.put(lights);
        this.bindTo(unit);
        return { light_table: { kind: "int", value: unit }, ...this.counts };
    }

    put(lights) {
        const integers = new Int32Array(4 * this.width * this.height), floats = new Float32Array(integers.buffer);
        const counts = new Map(Object.keys(this.models).map((model) => [model, 0]));
        for (const { model, members } of lights) {
            const { first, texels } = this.models[model].block, index = counts.get(model);
            counts.set(model, index + 1);
            members.forEach(({ kind, value }, i) => {
                const at = 4 * (first + index * texels + i);
                if (kind === "int") integers.set([value].flat(), at);
                else floats.set([value].flat(), at);
            });
        }
        this.fill(this.gl.RGBA_INTEGER, this.gl.INT, integers);
        const named = [...counts].map(([model, value]) => [this.models[model].block.count, { kind: "int", value }]);
        this.counts = Object.fromEntries(named);
        this.lights = lights;
    }
}
