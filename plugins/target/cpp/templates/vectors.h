struct vec2 {
    float x = 0, y = 0;
    vec2() = default;
    explicit vec2(float s) : x(s), y(s) {}
    vec2(float x_, float y_) : x(x_), y(y_) {}
};

struct vec3 {
    float x = 0, y = 0, z = 0;
    vec3() = default;
    explicit vec3(float s) : x(s), y(s), z(s) {}
    vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    vec3& operator+=(const vec3& b) { return *this = vec3(x + b.x, y + b.y, z + b.z); }
};

inline vec3 operator+(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
inline vec3 operator-(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
inline vec3 operator*(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
inline vec3 operator/(vec3 a, vec3 b) { return vec3(a.x / b.x, a.y / b.y, a.z / b.z); }
inline vec3 operator+(vec3 a, float s) { return a + vec3(s); }
inline vec3 operator-(vec3 a, float s) { return a - vec3(s); }
inline vec3 operator*(vec3 a, float s) { return a * vec3(s); }
inline vec3 operator/(vec3 a, float s) { return a / vec3(s); }
inline vec3 operator+(float s, vec3 a) { return vec3(s) + a; }
inline vec3 operator-(float s, vec3 a) { return vec3(s) - a; }
inline vec3 operator*(float s, vec3 a) { return vec3(s) * a; }
inline vec3 operator/(float s, vec3 a) { return vec3(s) / a; }
inline vec3 operator-(vec3 a) { return vec3(-a.x, -a.y, -a.z); }
inline vec2 operator+(vec2 a, vec2 b) { return vec2(a.x + b.x, a.y + b.y); }
inline vec2 operator-(vec2 a, vec2 b) { return vec2(a.x - b.x, a.y - b.y); }
inline vec2 operator*(vec2 a, vec2 b) { return vec2(a.x * b.x, a.y * b.y); }
inline vec2 operator/(vec2 a, vec2 b) { return vec2(a.x / b.x, a.y / b.y); }
inline vec2 operator*(vec2 a, float s) { return vec2(a.x * s, a.y * s); }
inline vec2 operator*(float s, vec2 a) { return a * s; }
inline vec2 operator/(vec2 a, float s) { return vec2(a.x / s, a.y / s); }

inline float min(float a, float b) { return std::min(a, b); }
inline vec3 min(vec3 a, vec3 b) { return vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)); }
inline int min(int a, int b) { return std::min(a, b); }

inline float max(float a, float b) { return std::max(a, b); }
inline vec3 max(vec3 a, vec3 b) { return vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)); }
inline int max(int a, int b) { return std::max(a, b); }

inline float clamp(float x, float low, float high) { return min(max(x, low), high); }
inline vec3 clamp(vec3 a, float l, float h) { return vec3(clamp(a.x, l, h), clamp(a.y, l, h), clamp(a.z, l, h)); }

inline float mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }
inline vec3 mix(vec3 a, vec3 b, float t) { return a * (1.0f - t) + b * t; }

inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }

inline float smoothstep(float edge0, float edge1, float x) {
    const float t = clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

inline float sign(float x) { return x > 0.0f ? 1.0f : (x < 0.0f ? -1.0f : 0.0f); }

inline float abs(float x) { return std::fabs(x); }
inline vec3 abs(vec3 a) { return vec3(abs(a.x), abs(a.y), abs(a.z)); }

inline float floor(float x) { return std::floor(x); }

inline float ceil(float x) { return std::ceil(x); }

inline float fract(float x) { return x - std::floor(x); }

inline float mod(float x, float y) { return x - y * std::floor(x / y); }

inline float sqrt(float x) { return std::sqrt(x); }
inline vec3 sqrt(vec3 a) { return vec3(sqrt(a.x), sqrt(a.y), sqrt(a.z)); }

inline float inversesqrt(float x) { return 1.0f / std::sqrt(x); }

inline float exp2(float x) { return std::exp2(x); }

inline float log2(float x) { return std::log2(x); }

inline float exp(float x) { return std::exp(x); }
inline vec3 exp(vec3 a) { return vec3(exp(a.x), exp(a.y), exp(a.z)); }

inline float log(float x) { return std::log(x); }

inline float pow(float x, float y) { return std::pow(x, y); }
inline vec3 pow(vec3 a, vec3 b) { return vec3(pow(a.x, b.x), pow(a.y, b.y), pow(a.z, b.z)); }

inline float radians(float degrees) { return 0.0174532925f * degrees; }

inline float degrees(float radians) { return 57.2957795f * radians; }

inline float sin(float x) { return std::sin(x); }

inline float cos(float x) { return std::cos(x); }

inline float tan(float x) { return std::tan(x); }

inline float asin(float x) { return std::asin(clamp(x, -1.0f, 1.0f)); }

inline float acos(float x) { return std::acos(clamp(x, -1.0f, 1.0f)); }

inline float atan(float x) { return std::atan(x); }
inline float atan(float y, float x) { return std::atan2(y, x); }

inline float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }

inline vec3 cross(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

inline float length(vec3 a) { return std::sqrt(dot(a, a)); }
inline float length(vec2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }

inline float distance(vec3 a, vec3 b) { return length(a - b); }

inline vec3 normalize(vec3 a) { return a / std::sqrt(max(dot(a, a), 1.0e-36f)); }

inline vec3 reflect(vec3 incident, vec3 normal) { return incident - 2.0f * dot(normal, incident) * normal; }

inline vec3 refract(vec3 incident, vec3 normal, float eta) {
    const float cosine = dot(normal, incident);
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    return k < 0.0f ? vec3(0.0f) : eta * incident - (eta * cosine + std::sqrt(k)) * normal;
}
