import { BufferAttribute, BufferGeometry, Mesh } from "three";
import { floatsOf, indicesOf } from "../../../../sdk/web/arrays.js";
import { VertexArrays, boxOf, sizeOf } from "../../../../sdk/web/vertex_arrays.js";

/** Whether a picture gives an object's colour, numbers of its material or its opacity, or tilts its normals. */
export const isTextured = ({ material, normal_map, opacity_map }) => [material, normal_map, opacity_map].some((text) => text !== null);

/** For three.js's own materials: positions, normals and colours, by their usual names. */
function usualGeometry({ position, normals, color, indices }) {
    const geometry = new BufferGeometry();
    const put = (name, array) => geometry.setAttribute(name, new BufferAttribute(floatsOf(array), 3));
    put("position", position);
    put("normal", normals[0]);
    if (color !== null) put("color", color);
    return geometry.setIndex(new BufferAttribute(indicesOf(indices), 1));
}

/** For kernels: everything that a shading model may ask for. */
function kernelGeometry(object) {
    const geometry = new BufferGeometry(), arrays = new VertexArrays(object.mesh);
    const sources = arrays.sourcesOf({
        rate: object.rate, seesTriangle: object.sees_triangle, isTextured: isTextured(object), hasOpacityMap: object.opacity_map !== null,
        opacityChannel: object.opacity_channel,
    }, 0);
    for (const [name, source] of Object.entries(sources)) {
        const size = sizeOf(name);
        const values = typeof source === "string" ? arrays.valuesOf(source)
            : Float32Array.from({ length: size * arrays.vertexCount }, (_, i) => source[i % size]);
        geometry.setAttribute(name, new BufferAttribute(values, size));
    }
    return geometry;
}

/** An object's triangles without a material, and the box around them. */
export function geometryOf(object) {
    const mesh = new Mesh(object.lambert === null ? kernelGeometry(object) : usualGeometry(object.mesh));
    mesh.frustumCulled = false;  // the camera's planes enclose the objects anyway
    return { mesh, bounds: boxOf(object) };
}
