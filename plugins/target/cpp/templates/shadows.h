// Shadows. From each place at which light is evaluated, a ray goes to the light; a surface that it meets on its way blocks
// the light. A solid object blocks light only where it enters, any other surface on both sides.

using Double3 = std::array<double, 3>;

const float k_infinitely_far = HUGE_VALF;

@CROSSING_STRUCT@
struct ShadowRay {
    Double3 origin, direction;
    double length;         // in multiples of the direction; infinite if the light is infinitely far away
    const Object* object;  // on whose surface it starts
    bool starts_below;     // the triangle that it starts on faces away from the light, although the shading normal does not
    bool starts_behind;    // it starts on the inner side of the triangle
@CROSSINGS_MEMBER@
};

struct Box {
    Double3 low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
};

struct Blocker {  // a triangle that casts a shadow
    std::array<Double3, 3> corners;
    const Object* object;
@BLOCKER_TRIANGLE@
};

Double3 double3(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// A ray meets a box if a part of the ray is between the box's two sides along all three axes. (A ray that runs within a side
// has 0 / 0 there, which min and max ignore.)
bool meets(const ShadowRay& ray, const Box& box) {
    double enters = 0, leaves = ray.length;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_backward = std::signbit(ray.direction[k]);
        const double near = is_backward ? box.high[k] : box.low[k], far = is_backward ? box.low[k] : box.high[k];
        enters = std::max(enters, (near - ray.origin[k]) / ray.direction[k]);
        leaves = std::min(leaves, (far - ray.origin[k]) / ray.direction[k]);
    }
    return enters <= leaves * (1 + 1e-15);  // the two are rounded
}

// Whether a triangle blocks a ray. It is moved so that the ray starts in the origin, and sheared so that the ray is an axis;
// along this axis, the origin must be on the same side of all three edges. Triangles with a common edge compute the same
// numbers for it, so no ray slips between them (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection").
bool blocks(const Blocker& blocker, const ShadowRay& ray) {
    const Double3 d = ray.direction, size = {std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])};
    const std::size_t z = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    const std::size_t x = (z + 1) % 3, y = (z + 2) % 3;
    std::array<Double3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
        const Double3& corner = blocker.corners[k];
        const double along = (corner[z] - ray.origin[z]) / d[z];
        p[k] = {corner[x] - ray.origin[x] - along * d[x], corner[y] - ray.origin[y] - along * d[y], along};
    }
    const double a = p[1][0] * p[2][1] - p[1][1] * p[2][0], b = p[2][0] * p[0][1] - p[2][1] * p[0][0];
    const double c = p[0][0] * p[1][1] - p[0][1] * p[1][0], area = a + b + c;
    if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return false;
    const double distance = (a * p[0][2] + b * p[1][2] + c * p[2][2]) / area;
    if (!(distance > 0 && distance <= ray.length)) return false;  // also if the area is 0

    // The ray enters the object if it meets the triangle's outer side, whose corners run counter-clockwise.
    const bool enters = (area < 0) != (d[z] < 0);
    if (blocker.object->is_solid) return enters;
    // Light that leaves the surface on which it is looked for may pass, so that smooth shading has no jagged edge where the
    // triangles turn away from the light.
    @BLOCKS@blocker.object != ray.object || !ray.starts_below || enters != ray.starts_behind;
@LET_PASS@
}

// All triangles that cast shadows in a bounding-volume hierarchy, a tree of boxes: a ray that misses a box misses everything in
// it, so that it is compared with some log n of n triangles.
class ShadowTree {
  public:
    explicit ShadowTree(const std::vector<Object>& objects) {
        for (const Object& o : objects) {
            for (std::size_t c = 0; o.casts_shadows && c < o.mesh.corners.size(); c += 3) {
                const auto at = [&](std::size_t k) { return o.mesh.position[static_cast<std::size_t>(o.mesh.corners[c + k])]; };
                blockers_.push_back({{double3(at(0)), double3(at(1)), double3(at(2))}, &o@TRIANGLE_NUMBER@});
                for (const vec3 edge : {at(1) - at(0), at(2) - at(0)}) {
                    const float size = std::max({std::fabs(edge.x), std::fabs(edge.y), std::fabs(edge.z)});
                    if (!o.is_solid) largest_ = std::max(largest_, size);
                }
            }
        }
        build(0, blockers_.size());
    }

    // How far from a surface a ray must start, so that it does not meet the same surface because of rounding.
    float margin_at(vec3 place) const {
        return 0x1p-20f * std::max({largest_, std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)});
    }

    bool is_blocked(const ShadowRay& ray, std::size_t node = 0) const {
        const Node& n = nodes_[node];
        if (!meets(ray, n.box)) return false;
        if (n.right != 0) return is_blocked(ray, node + 1) || is_blocked(ray, n.right);
        return std::any_of(blockers_.begin() + n.first, blockers_.begin() + n.end, [&](const Blocker& b) { return blocks(b, ray); });
    }

  private:
    struct Node {
        Box box;
        std::ptrdiff_t first, end;  // its triangles
        std::size_t right = 0;      // the second of its parts; the first one is the next node. 0: it is not divided
    };

    // Divides triangles into two equal parts along the longest side of their box, and these again.
    void build(std::size_t first, std::size_t end) {
        const std::size_t node = nodes_.size();
        nodes_.push_back({{}, static_cast<std::ptrdiff_t>(first), static_cast<std::ptrdiff_t>(end), 0});
        Box& box = nodes_.back().box;
        for (std::size_t i = first; i < end; ++i) {
            for (const Double3& p : blockers_[i].corners) {
                for (std::size_t k = 0; k < 3; ++k) box.low[k] = std::min(box.low[k], p[k]), box.high[k] = std::max(box.high[k], p[k]);
            }
        }
        if (end - first <= 4) return;
        const Double3 size = {box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]};
        const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
        const auto centre = [&](const Blocker& b) { return b.corners[0][axis] + b.corners[1][axis] + b.corners[2][axis]; };
        const std::size_t middle = (first + end) / 2;
        const auto begin = blockers_.begin();
        std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle), begin + static_cast<std::ptrdiff_t>(end),
                         [&](const Blocker& p, const Blocker& q) { return centre(p) < centre(q); });
        build(first, middle);
        nodes_[node].right = nodes_.size();
        build(middle, end);
    }

    std::vector<Blocker> blockers_;
    std::vector<Node> nodes_;
    float largest_ = 0;  // of the triangles that block light on both sides, along an axis
};

struct Pixel {
    std::uint32_t x = 0, y = 0;  // remain 0 where the light of a face or a vertex is looked for
};

// A place on a surface, where its light is looked for.
struct ShadowPlace {
    const ShadowTree& tree;
    const Object& object;
    vec3 position, normal, face_normal;  // the shading normal; that of the triangle, both on the visible side
    bool is_back;
    Pixel pixel;
    int triangle;  // -1 at a vertex
};

// Whether the normal turns away from a light as one moves towards it across the triangle: the surface that the triangle
// stands for is hollow there, rises towards the light, and blocks it.
bool is_hollow(const ShadowPlace& at, vec3 to_light) {
    if (at.triangle < 0) return false;
    const Object& o = at.object;
    const auto t = static_cast<std::size_t>(at.triangle);
    const vec3 aside = cross(to_light, o.face_normal[t]);
    const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(o.mesh.corners[3 * t + k % 3]); };
    float turn = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const vec3 opposite = o.mesh.position[corner(k + 2)] - o.mesh.position[corner(k + 1)];
        turn += dot(opposite, aside) * dot(o.vertex_normal[corner(k)], to_light);
    }
    return at.is_back ? turn > 0 : turn < 0;
}

// Along the surface towards a place.
vec3 along_surface(const ShadowPlace& at, vec3 place) {
    const vec3 towards = normalize(place - at.position);
    return towards - dot(at.face_normal, towards) * at.face_normal;
}

vec3 middle_of_triangle(const ShadowPlace& at) {
    const Mesh& m = at.object.mesh;
    const auto corner = [&](int k) { return m.position[static_cast<std::size_t>(m.corners[static_cast<std::size_t>(3 * at.triangle + k)])]; };
    return (corner(0) + corner(1) + corner(2)) / 3.0f;
}

@PASSING@
// The fraction of the light from a direction that reaches a place@ZERO_OR_ONE@.
float unblocked(const ShadowPlace& at, vec3 to_light, float distance) {
    const bool reflects = @REFLECTS@;
    if (!at.object.receives_shadows || !reflects) return 1.0f;
    const float margin = at.tree.margin_at(at.position);
    // Light that only models ask for that wrap it around always comes from below, whichever way the triangle faces.
    const bool is_below = dot(at.normal, to_light) < 0 || (dot(at.face_normal, to_light) < 0 && !is_hollow(at, to_light));
    const float length = distance * 0.9999990f - 2.0f * margin;
    if (!(length > 2.0f * margin)) return 1.0f;
    // Above the surface and a little before the place, so that walls that meet in it are in the way; or below and after it.
    vec3 shift = (is_below ? -margin : margin) * (2.0f * at.face_normal - to_light);
    // In the edge of a room, that is behind the adjacent wall; so rays also start further inside their triangle.
    if (at.triangle >= 0 && !at.object.is_solid) shift += 4.0f * margin * along_surface(at, middle_of_triangle(at));
@AT_VERTICES@
@CROSSINGS@
    return at.tree.is_blocked({double3(at.position + shift), double3(to_light - shift / distance), static_cast<double>(length), &at.object, is_below, at.is_back@CROSSINGS_ARGUMENT@}) ? 0.0f : @IF_FREE@;
}
