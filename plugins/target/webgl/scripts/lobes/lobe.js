import { add, cross, dot, length, normalize, scale, subtract } from "../../../../../sdk/web/vectors.js";

const ROWS = 48, COLUMNS = 96;  // of the grid
const HORIZON = 89.9;           // degrees from N, just above the surface
const STEPS = 360;              // of the curve

/** Rec. 709. */
export const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** Axes at a point: N, the direction along the surface in which a mirror sends the light, and the third. */
function axesAt({ N, V }, { L }) {
    const along = (v) => subtract(v, scale(N, dot(N, v)));
    // Light that arrives along N has no plane of incidence, so the observer's is used.
    const candidates = [scale(along(L), -1), along(V), ...[[1, 0, 0], [0, 1, 0]].map(along)];
    const mirror = normalize(candidates.find((v) => length(v) > 1e-3));
    return { normal: N, mirror, across: cross(N, mirror) };
}

const direction = ({ normal, mirror, across }, polar, azimuth) => {
    const sine = Math.sin(polar);
    return add(scale(normal, Math.cos(polar)), add(scale(mirror, sine * Math.cos(azimuth)), scale(across, sine * Math.sin(azimuth))));
};
const radians = (degrees) => (degrees * Math.PI) / 180;

/** The directions of the plane of incidence, and their angles with N in degrees: negative on the light's side. */
export function planeOfIncidence(point, light) {
    const axes = axesAt(point, light);
    const angles = Array.from({ length: STEPS + 1 }, (_, i) => HORIZON * ((2 * i) / STEPS - 1));
    return { angles, directions: angles.map((angle) => direction(axes, radians(angle), 0)) };
}

/** The angle of the mirror direction with N in degrees; the light's angle is its negative. */
export const mirrorAngle = ({ N }, { L }) => (Math.acos(Math.max(-1, Math.min(1, dot(N, L)))) * 180) / Math.PI;

/**
 * All directions above a surface, as rows of equal angles with N. They are denser near the mirror direction, where lobes are
 * narrow.
 */
export function hemisphere(point, light) {
    const axes = axesAt(point, light);
    const middle = Math.max(1, Math.min(HORIZON - 1, mirrorAngle(point, light)));
    const warp = (t) => t * Math.abs(t);
    const polar = (i) => {
        const at = (i / ROWS) * HORIZON;
        return at < middle ? middle * (1 + warp(at / middle - 1)) : middle + (HORIZON - middle) * warp((at - middle) / (HORIZON - middle));
    };
    const directions = [];
    for (let i = 0; i <= ROWS; ++i) {
        for (let k = 0; k <= COLUMNS; ++k) directions.push(direction(axes, radians(polar(i)), Math.PI * warp((2 * k) / COLUMNS - 1)));
    }
    return { rows: ROWS, columns: COLUMNS, directions };
}

/**
 * The intensity that a reflection model sends into each direction: its own shader code, run once per direction. `uniforms`: the
 * material's; `point` and `light`: as described by `candela explain`.
 */
export function reflectedInto(renderer, reflection, uniforms, point, light, directions) {
    const { gl } = renderer, program = renderer.programs.lobe(reflection).check();
    const vertexArray = gl.createVertexArray(), feedback = gl.createTransformFeedback();
    const [input, output] = [gl.createBuffer(), gl.createBuffer()], values = new Float32Array(3 * directions.length);
    gl.bindVertexArray(vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, input);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(directions.flat()), gl.STREAM_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    gl.bindBuffer(gl.COPY_READ_BUFFER, output);
    gl.bufferData(gl.COPY_READ_BUFFER, values.byteLength, gl.STREAM_READ);
    gl.bindBuffer(gl.COPY_READ_BUFFER, null);
    gl.useProgram(program.handle);
    const ofPoint = { normal: point.N, tangent: point.tangent, color: point.C_o, position: point.position, to_light: light.L, diffuse: light.diffuse, specular: light.specular };
    for (const [name, value] of Object.entries(ofPoint)) program.setUniform(`lobe_${name}`, { kind: "vec3", value });
    for (const [name, uniform] of [...uniforms, ...Object.entries(renderer.bindTables())]) program.setUniform(name, uniform);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, feedback);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, output);
    // Any drawing to the canvas clears it, even if no pixel is drawn.
    const film = renderer.createFilm(1, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, film.picture.framebuffer);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, directions.length);
    gl.endTransformFeedback();
    gl.disable(gl.RASTERIZER_DISCARD);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    film.release();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
    gl.bindBuffer(gl.COPY_READ_BUFFER, output);
    gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, values);
    gl.bindBuffer(gl.COPY_READ_BUFFER, null);
    gl.bindVertexArray(null);
    gl.deleteTransformFeedback(feedback);
    gl.deleteVertexArray(vertexArray);
    for (const buffer of [input, output]) gl.deleteBuffer(buffer);
    return directions.map((_, i) => [...values.subarray(3 * i, 3 * i + 3)]);
}
