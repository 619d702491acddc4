// Meshes as the graphics processor takes them: every triangle has its own three vertices.

const ATTRIBUTES = ["position", "place", "vertex_normal", "face_normal", "uv", "dpdu", "dpdv", "barycentric"];

function boxOf(positions) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], positions[i]);
        high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
    return { low, high };
}

/// Values of vertices, repeated for every corner.
function atCorners(values, corners, size) {
    const result = new Float32Array(corners.length * size);
    for (let i = 0; i < corners.length; ++i) {
        for (let k = 0; k < size; ++k) result[i * size + k] = values[corners[i] * size + k];
    }
    return result;
}

/// Values at corners, each replaced by the mean of its triangle's.
function meansOf(values, size) {
    const result = new Float32Array(values.length);
    for (let i = 0; i < values.length; i += 3 * size) {
        for (let k = 0; k < size; ++k) {
            const mean = (values[i + k] + values[i + size + k] + values[i + 2 * size + k]) / 3;
            result[i + k] = result[i + size + k] = result[i + 2 * size + k] = mean;
        }
    }
    return result;
}

function faceNormals(positions) {
    const result = new Float32Array(positions.length);
    const corner = (i) => [positions[i], positions[i + 1], positions[i + 2]];
    for (let i = 0; i < positions.length; i += 9) {
        const normal = normalized(cross(subtract(corner(i + 3), corner(i)), subtract(corner(i + 6), corner(i))));
        for (let k = 0; k < 9; ++k) result[i + k] = normal[k % 3];
    }
    return result;
}

/// An object's triangles; arrays go to the graphics processor when a shading model first asks for them.
class MeshBuffers {
    constructor(gl, mesh) {
        this.gl = gl;
        this.mesh = mesh;
        this.corners = integersOf(mesh.corners);
        this.count = this.corners.length;
        const positions = floatsOf(mesh.position);
        this.box = boxOf(positions);
        this.positions = atCorners(positions, this.corners, 3);
        this.buffers = new Map();
        this.arrays = new Map();
    }

    /// For an own array of each attribute, or three numbers where it is the same everywhere.
    attributes(rate, set) {
        const { uv, dpdu, dpdv } = this.mesh;
        const mean = rate === "face" ? " mean" : "";
        const normal = `normals ${set}${mean}`;
        return {
            position: "position",
            place: `position${mean}`,
            vertex_normal: normal,
            face_normal: rate === "vertex" ? normal : "face normals",
            uv: uv === null ? [0, 0, 0] : `uv${mean}`,
            dpdu: dpdu === null ? [0, 0, 0] : `dpdu${mean}`,
            dpdv: dpdv === null ? [0, 0, 0] : `dpdv${mean}`,
            barycentric: { face: [1 / 3, 1 / 3, 1 / 3], vertex: [1, 0, 0], fragment: "barycentric" }[rate],
        };
    }

    valuesOf(name) {
        if (name.endsWith(" mean")) {
            const base = name.slice(0, -5);
            return meansOf(this.valuesOf(base), base === "uv" ? 2 : 3);
        }
        if (name === "position") return this.positions;
        if (name === "face normals") return faceNormals(this.positions);
        if (name === "barycentric") return Float32Array.from({ length: 3 * this.count }, (_, i) => (i % 9) % 4 === 0);
        if (name.startsWith("normals ")) return atCorners(floatsOf(this.mesh.normals[Number(name.slice(8))]), this.corners, 3);
        return atCorners(floatsOf(this.mesh[name]), this.corners, name === "uv" ? 2 : 3);
    }

    buffer(name) {
        if (!this.buffers.has(name)) {
            const buffer = this.gl.createBuffer();
            this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
            this.gl.bufferData(this.gl.ARRAY_BUFFER, this.valuesOf(name), this.gl.STATIC_DRAW);
            this.buffers.set(name, buffer);
        }
        return this.buffers.get(name);
    }

    vertexArray(attributes, key) {
        if (this.arrays.has(key)) return this.arrays.get(key);
        const { gl } = this;
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        ATTRIBUTES.forEach((attribute, location) => {
            if (typeof attributes[attribute] !== "string") return;
            const buffer = this.buffer(attributes[attribute]);
            gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
            gl.enableVertexAttribArray(location);
            gl.vertexAttribPointer(location, attribute === "uv" ? 2 : 3, gl.FLOAT, false, 0, 0);
        });
        this.arrays.set(key, array);
        return array;
    }

    draw(rate, shading) {
        const { gl } = this;
        const set = this.mesh.normals_of[shading];
        const attributes = this.attributes(rate, set);
        gl.bindVertexArray(this.vertexArray(attributes, `${rate} ${set}`));
        // What is the same everywhere belongs to the context, not to the vertex array.
        ATTRIBUTES.forEach((attribute, location) => {
            if (typeof attributes[attribute] !== "string") gl.vertexAttrib3f(location, ...attributes[attribute]);
        });
        gl.drawArrays(gl.TRIANGLES, 0, this.count);
        gl.bindVertexArray(null);
    }
}
