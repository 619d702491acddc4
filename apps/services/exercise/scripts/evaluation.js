import { decodeFloats } from "../../../../sdk/web/base64.js";
import { numbered } from "../../../../sdk/web/editor/problems.js";
import { Program } from "../../../../sdk/web/programs.js";

export const TERMS = ["ambient", "diffuse", "specular"];
const PER_POINT = 3 * TERMS.length;

/** Runs a formula at the points of the exercise's ball, on the graphics processor. */
export class Evaluation {
    /** Throws if WebGL 2 is unavailable. */
    constructor(exercise) {
        this.exercise = exercise;
        this.gl = document.createElement("canvas").getContext("webgl2");
        if (this.gl === null) throw new Error("Trying formulas needs WebGL 2, which this browser does not support. You can still write and save answers.");
        const { gl } = this, normals = decodeFloats(exercise.normals), tangents = decodeFloats(exercise.tangents);
        this.count = normals.length / 3;
        gl.bindVertexArray(gl.createVertexArray());
        [normals, tangents].forEach((values, location) => {
            gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
            gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
            gl.enableVertexAttribArray(location);
            gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 0, 0);
        });
        gl.bindBuffer(gl.ARRAY_BUFFER, null);
        this.output = gl.createBuffer();
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, this.output);
        gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 4 * PER_POINT * this.count, gl.STREAM_READ);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
    }

    /** The results of a body: for each case an object of arrays by term, with three numbers per point. Throws an error whose `detail` is the driver's log. */
    valuesOf(body) {
        const { gl, exercise } = this, { before, after, points } = exercise.glsl;
        const program = new Program(gl, "the formula", `${before}${numbered(body)}${after}\n${points}`, "void main() {}", TERMS);
        try {
            program.check();
            gl.useProgram(program.handle);
            return exercise.cases.map((one) => this.valuesOfCase(program, one));
        } finally {
            gl.deleteProgram(program.handle);
        }
    }

    valuesOfCase(program, { to_light: toLight, material }) {
        const { gl, exercise, count } = this, all = new Float32Array(PER_POINT * count);
        program.setUniform("point_color", { kind: "vec3", value: exercise.color });
        program.setUniform("point_to_light", { kind: "vec3", value: toLight });
        for (const { name, kind, value } of material) program.setUniform(name, { kind, value: value.length === 1 ? value[0] : value });
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.output);
        gl.enable(gl.RASTERIZER_DISCARD);
        gl.beginTransformFeedback(gl.POINTS);
        gl.drawArrays(gl.POINTS, 0, count);
        gl.endTransformFeedback();
        gl.disable(gl.RASTERIZER_DISCARD);
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
        gl.bindBuffer(gl.COPY_READ_BUFFER, this.output);
        gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, all);
        gl.bindBuffer(gl.COPY_READ_BUFFER, null);
        return Object.fromEntries(TERMS.map((term, k) => {
            const values = new Float32Array(3 * count);
            for (let i = 0; i < count; ++i) values.set(all.subarray(PER_POINT * i + 3 * k, PER_POINT * i + 3 * k + 3), 3 * i);
            return [term, values];
        }));
    }
}
