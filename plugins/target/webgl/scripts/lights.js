/** The lights' parameters for shaders: a texture with a texel for each, as bits. */
export class LightTable {
    constructor(gl, scene) {
        this.gl = gl;
        this.models = scene.light_models;
        this.width = scene.light_table_width;
        const blocks = Object.values(this.models).map(({ block }) => block);
        const total = blocks.reduce((sum, { lights, texels }) => sum + lights * texels, 0);
        this.height = Math.max(1, Math.ceil(total / this.width));
        if (this.height > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error("This device's graphics do not have room for this many lights.");
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32I, this.width, this.height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    release() {
        this.gl.deleteTexture(this.texture);
    }

    /** Binds the table, filled with an appearance's lights, to a texture unit; returns the uniforms with which they are read. */
    bind(unit, lights) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        if (this.lights !== lights) this.fill(lights);
        gl.activeTexture(gl.TEXTURE0);
        return { light_table: { kind: "int", value: unit }, ...this.counts };
    }

    fill(lights) {
        const { gl } = this, integers = new Int32Array(4 * this.width * this.height), floats = new Float32Array(integers.buffer);
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
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, this.width, this.height, gl.RGBA_INTEGER, gl.INT, integers);
        const named = [...counts].map(([model, value]) => [this.models[model].block.count, { kind: "int", value }]);
        this.counts = Object.fromEntries(named);
        this.lights = lights;
    }
}
