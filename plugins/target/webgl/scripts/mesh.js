import { ATTRIBUTES, LOCATIONS, VertexArrays, sizeOf } from "../../../../sdk/web/vertex_arrays.js";

/** An object's triangles on the GPU. Buffers are filled when a shading model first asks for them. */
export class Mesh {
    constructor(gl, mesh) {
        this.gl = gl;
        this.users = 0;  // renderers
        this.mesh = mesh;
        this.arrays = new VertexArrays(mesh);
        this.bounds = this.arrays.bounds;
        this.buffers = new Map();
        this.vertexArrays = new Map();
    }

    buffer(name) {
        if (!this.buffers.has(name)) {
            const buffer = this.gl.createBuffer();
            this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
            this.gl.bufferData(this.gl.ARRAY_BUFFER, this.arrays.valuesOf(name), this.gl.STATIC_DRAW);
            this.buffers.set(name, buffer);
        }
        return this.buffers.get(name);
    }

    vertexArray(sources, key) {
        if (this.vertexArrays.has(key)) return this.vertexArrays.get(key);
        const { gl } = this;
        const vertexArray = gl.createVertexArray();
        gl.bindVertexArray(vertexArray);
        for (const [attribute, source] of Object.entries(sources)) {
            if (typeof source !== "string") continue;
            gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer(source));
            gl.enableVertexAttribArray(LOCATIONS[attribute]);
            gl.vertexAttribPointer(LOCATIONS[attribute], sizeOf(attribute), gl.FLOAT, false, 0, 0);
        }
        this.vertexArrays.set(key, vertexArray);
        return vertexArray;
    }

    /** Whether a scene's mesh is the same as this one for a renderer. */
    isOf(mesh) {
        const areEqual = (a, b) => a === b || (a instanceof Object && JSON.stringify(a) === JSON.stringify(b));
        return ["vertices", "indices", "position", "uv", "dpdu", "dpdv", "color", "channels", "normals", "normals_of"].every((name) => areEqual(this.mesh[name], mesh[name]));
    }

    release() {
        this.users -= 1;
        if (this.users > 0) return;
        for (const buffer of this.buffers.values()) this.gl.deleteBuffer(buffer);
        for (const vertexArray of this.vertexArrays.values()) this.gl.deleteVertexArray(vertexArray);
    }

    /** `rate`: how often the shading model evaluates light, per "face", "vertex" or "fragment". */
    draw({ rate, shading, seesTriangle, isTextured, opacityMap, opacityChannel }) {
        const { gl } = this;
        const normalSet = this.mesh.normals_of[shading], hasOpacityMap = opacityMap !== null;
        const sources = this.arrays.sourcesOf({ rate, seesTriangle, isTextured, hasOpacityMap, opacityChannel }, normalSet);
        gl.bindVertexArray(this.vertexArray(sources, `${rate} ${normalSet} ${seesTriangle} ${isTextured} ${hasOpacityMap} ${opacityChannel}`));
        // Constant attributes are state of the context, not of the vertex array.
        ATTRIBUTES.forEach((attribute, i) => {
            if (typeof sources[attribute] !== "string") gl.vertexAttrib3f(i, ...sources[attribute]);
        });
        gl.drawArrays(gl.TRIANGLES, 0, this.arrays.vertexCount);
        gl.bindVertexArray(null);
    }
}
