import { floatsOf, indicesOf } from "./arrays.js";
import { cross, normalize, subtract } from "./vectors.js";

/** The vertex shader's inputs, in the order of their locations. */
export const ATTRIBUTES = ["position", "place", "vertex_normal", "face_normal", "uv", "dpdu", "dpdv", "barycentric",
    "vertex_color"];
/** The inputs of shading models that read their triangle, equal at its three vertices. */
export const TRIANGLE_ATTRIBUTES = ["p0", "p1", "p2", "n0", "n1", "n2"];
/** Numbers of the vertices, in the places of n0, n1, n2. The first two may be second texture coordinates. "channel_edges": how two of them change. */
const CHANNEL_ATTRIBUTES = ["channel_edges", "channels_0", "channels_1"];
/** The location of each of the vertex shader's inputs. "uv_edges": how u and v change from a triangle's first vertex to the second and the third. */
export const LOCATIONS = Object.fromEntries([
    ...[...ATTRIBUTES, ...TRIANGLE_ATTRIBUTES].entries(), ...CHANNEL_ATTRIBUTES.map((name, i) => [12 + i, name]), [15, "uv_edges"],
].map(([location, name]) => [name, location]));
export const sizeOf = (attribute) => ({ uv: 2, uv_edges: 4, channel_edges: 4, channels_0: 4, channels_1: 4 })[attribute] ?? 3;

function boundsOf(positions) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], positions[i]);
        high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
    return { low, high };
}

/** The box around an object of the scene. */
export const boxOf = ({ mesh }) => boundsOf(floatsOf(mesh.position));

function expandIndexed(values, indices, size) {
    const result = new Float32Array(indices.length * size);
    for (let i = 0; i < indices.length; ++i) {
        for (let k = 0; k < size; ++k) result[i * size + k] = values[indices[i] * size + k];
    }
    return result;
}

/** Each triangle's three values replaced by their mean. */
function averagePerTriangle(values, size) {
    const result = new Float32Array(values.length);
    for (let i = 0; i < values.length; i += 3 * size) {
        for (let k = 0; k < size; ++k) {
            const mean = (values[i + k] + values[i + size + k] + values[i + 2 * size + k]) / 3;
            result[i + k] = result[i + size + k] = result[i + 2 * size + k] = mean;
        }
    }
    return result;
}

/** Each triangle's three values replaced by one of them. */
function repeatCorner(values, corner) {
    return values.map((_, i) => values[i - (i % 9) + 3 * corner + (i % 3)]);
}

/** For each triangle, the differences of its second and third pair from the first, at each of its vertices. */
function edgesPerTriangle(uv) {
    const result = new Float32Array(2 * uv.length);
    for (let i = 0; i < uv.length; i += 6) {
        for (let k = 0; k < 12; ++k) result[2 * i + k] = uv[i + 2 + (k % 4)] - uv[i + (k % 2)];
    }
    return result;
}

function faceNormals(positions) {
    const result = new Float32Array(positions.length);
    const vertex = (i) => [positions[i], positions[i + 1], positions[i + 2]];
    for (let i = 0; i < positions.length; i += 9) {
        const normal = normalize(cross(subtract(vertex(i + 3), vertex(i)), subtract(vertex(i + 6), vertex(i))));
        for (let k = 0; k < 9; ++k) result[i + k] = normal[k % 3];
    }
    return result;
}

/**
 * An object's triangles in the form that vertex shaders read. Triangles do not share vertices, so that values per face can
 * differ between them.
 */
export class VertexArrays {
    constructor(mesh) {
        this.mesh = mesh;
        this.indices = indicesOf(mesh.indices);
        this.vertexCount = this.indices.length;
        const positions = floatsOf(mesh.position);
        this.bounds = boundsOf(positions);
        this.positions = expandIndexed(positions, this.indices, 3);
    }

    /** The sources of the numbers of the vertices. `opacityChannel`: the first of two that the opacity reads, or null. */
    channelSources(rate, opacityChannel) {
        const { channels, has_second_uv: hasSecondUv } = this.mesh;
        if (!channels?.length) return {};
        const mean = rate === "face" ? " mean" : "", withEdges = rate !== "fragment" ? opacityChannel : hasSecondUv ? 0 : null;
        return {
            channels_0: `channels 0${mean}`,
            ...(channels.length > 4 ? { channels_1: `channels 1${mean}` } : {}),
            ...(withEdges !== null ? { channel_edges: `edges of channels ${withEdges}` } : {}),
        };
    }

    /** For each attribute the name of its values, or three numbers if it is the same everywhere. */
    sourcesOf({ rate, seesTriangle, isTextured, hasOpacityMap = false, opacityChannel = null }, normalSet) {
        const { uv, dpdu, dpdv, color } = this.mesh;
        const mean = rate === "face" ? " mean" : "", readsAtFragment = isTextured && (rate === "fragment" || hasOpacityMap);
        const normals = `normals ${normalSet}${mean}`;
        const triangle = TRIANGLE_ATTRIBUTES.map((name) =>
            [name, `${name[0] === "p" ? "position" : `normals ${normalSet}`} of ${name[1]}`]);
        return {
            ...(seesTriangle ? Object.fromEntries(triangle) : {}),
            ...(readsAtFragment ? Object.fromEntries(triangle.slice(0, 3)) : {}),
            ...(readsAtFragment && uv !== null ? { uv_edges: "uv edges" } : {}),
            ...(isTextured ? this.channelSources(rate, opacityChannel) : {}),
            position: "position",
            place: `position${mean}`,
            vertex_normal: normals,
            face_normal: rate === "vertex" ? normals : "face normals",
            uv: uv === null ? [0, 0, 0] : `uv${mean}`,
            dpdu: dpdu === null ? [0, 0, 0] : `dpdu${mean}`,
            dpdv: dpdv === null ? [0, 0, 0] : `dpdv${mean}`,
            barycentric: { face: [1 / 3, 1 / 3, 1 / 3], vertex: [1, 0, 0], fragment: "barycentric" }[rate],
            vertex_color: color === null ? [1, 1, 1] : `color${mean}`,
        };
    }

    /** `size` numbers of each vertex, from a channel on; 0 for absent channels. */
    channels(first, size) {
        const channels = this.mesh.channels.slice(first, first + size).map(floatsOf);
        return Float32Array.from({ length: size * this.vertexCount }, (_, i) => channels[i % size]?.[this.indices[Math.floor(i / size)]] ?? 0);
    }

    valuesOf(name) {
        if (name.endsWith(" mean")) {
            const base = name.slice(0, -" mean".length);
            return averagePerTriangle(this.valuesOf(base), base === "uv" ? 2 : base.startsWith("channels ") ? 4 : 3);
        }
        if (name.startsWith("channels ")) return this.channels(4 * Number(name.at(-1)), 4);
        if (name.startsWith("edges of channels ")) return edgesPerTriangle(this.channels(Number(name.at(-1)), 2));
        if (/ of [012]$/.test(name)) return repeatCorner(this.valuesOf(name.slice(0, -" of 0".length)), Number(name.at(-1)));
        if (name === "uv edges") return edgesPerTriangle(this.valuesOf("uv"));
        if (name === "position") return this.positions;
        if (name === "face normals") return faceNormals(this.positions);
        if (name === "barycentric") return Float32Array.from({ length: 3 * this.vertexCount }, (_, i) => (i % 9) % 4 === 0);
        if (name.startsWith("normals ")) {
            const normalSet = Number(name.slice("normals ".length));
            return expandIndexed(floatsOf(this.mesh.normals[normalSet]), this.indices, 3);
        }
        return expandIndexed(floatsOf(this.mesh[name]), this.indices, name === "uv" ? 2 : 3);
    }
}
