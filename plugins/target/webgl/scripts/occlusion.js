import { clippingPlanes, viewAxes, viewProjection } from "../../../../sdk/web/camera.js";
import { add, dot, scale, subtract } from "../../../../sdk/web/vectors.js";

const VERTEX = `
uniform mat4 view_projection;
uniform vec3 place;

void main() {
    gl_Position = view_projection * vec4(place, 1.0);
    gl_PointSize = 1.0;
}`;

// The depths are the same as in the lit picture.
const FRAGMENT = `
uniform float near;
uniform int is_orthographic;

layout(location = 0) out vec4 intensity;

void main() {
    gl_FragDepth = is_orthographic == 1 ? 1.0 - gl_FragCoord.z : near * gl_FragCoord.w;
    intensity = vec4(0.0);
}`;

/**
 * Which of some places are visible and not behind an object in the picture just drawn into a film, by an occlusion query
 * against its depth buffer. Resolves to a boolean for each; never resolves if the graphics are lost first.
 */
export function seenPlaces(renderer, film, observer, places) {
    const { gl, bounds } = renderer, { forward } = viewAxes(observer), { near, far } = clippingPlanes(observer, forward, bounds);
    const program = renderer.programs.own("the places of lights", VERTEX, FRAGMENT);
    gl.bindFramebuffer(gl.FRAMEBUFFER, film.picture.framebuffer);
    gl.viewport(0, 0, film.width, film.height);
    gl.useProgram(program.handle);
    program.setUniform("view_projection", { kind: "mat4", value: viewProjection(observer, bounds, film.width, film.height, [0, 0]) });
    program.setUniform("near", { kind: "float", value: near });
    program.setUniform("is_orthographic", { kind: "int", value: observer.projection === "orthographic" ? 1 : 0 });
    gl.bindVertexArray(renderer.emptyVertexArray);
    gl.depthMask(false);
    gl.colorMask(false, false, false, false);
    const queries = places.map((place) => {
        // A place in front of all objects, or behind all of them, is outside the clipping planes.
        const depth = dot(forward, subtract(place, observer.position));
        const inside = Math.min(Math.max(depth, near * 1.001), Math.max(far * 0.999, near * 1.001));
        const isClamped = observer.projection === "orthographic" || depth < near;
        const query = gl.createQuery();
        gl.beginQuery(gl.ANY_SAMPLES_PASSED, query);
        program.setUniform("place", { kind: "vec3", value: isClamped ? add(place, scale(forward, inside - depth)) : place });
        gl.drawArrays(gl.POINTS, 0, 1);
        gl.endQuery(gl.ANY_SAMPLES_PASSED);
        return query;
    });
    gl.colorMask(true, true, true, true);
    gl.depthMask(true);
    gl.bindVertexArray(null);
    return new Promise((resolve) => {
        const poll = () => {
            if (gl.isContextLost()) return;
            if (queries.length > 0 && !gl.getQueryParameter(queries.at(-1), gl.QUERY_RESULT_AVAILABLE)) {
                setTimeout(poll, 4);
                return;
            }
            const results = queries.map((query) => Boolean(gl.getQueryParameter(query, gl.QUERY_RESULT)));
            for (const query of queries) gl.deleteQuery(query);
            resolve(results);
        };
        setTimeout(poll, 0);
    });
}
