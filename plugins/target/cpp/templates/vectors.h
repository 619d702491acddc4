struct vec2 {
    float x = 0, y = 0;
    SWIZZLES
    vec2() = default;
    explicit vec2(float s) : x(s), y(s) {}
    vec2(float x_, float y_) : x(x_), y(y_) {}
};

struct vec3 {
    float x = 0, y = 0, z = 0;
    SWIZZLES
    vec3() = default;
    explicit vec3(float s) : x(s), y(s), z(s) {}
    vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    vec3(vec2 v, float z_) : x(v.x), y(v.y), z(z_) {}
    vec3(float x_, vec2 v) : x(x_), y(v.x), z(v.y) {}
    vec3& operator+=(const vec3& b) { return *this = vec3(x + b.x, y + b.y, z + b.z); }
};

struct vec4 {
    float x = 0, y = 0, z = 0, w = 0;
    SWIZZLES
    vec4() = default;
    explicit vec4(float s) : x(s), y(s), z(s), w(s) {}
    vec4(float x_, float y_, float z_, float w_) : x(x_), y(y_), z(z_), w(w_) {}
    vec4(vec3 v, float w_) : x(v.x), y(v.y), z(v.z), w(w_) {}
    vec4(float x_, vec3 v) : x(x_), y(v.x), z(v.y), w(v.z) {}
    vec4(vec2 a, vec2 b) : x(a.x), y(a.y), z(b.x), w(b.y) {}
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
inline vec2 operator+(vec2 a, float s) { return a + vec2(s); }
inline vec2 operator-(vec2 a, float s) { return a - vec2(s); }
inline vec2 operator*(vec2 a, float s) { return a * vec2(s); }
inline vec2 operator/(vec2 a, float s) { return a / vec2(s); }
inline vec2 operator+(float s, vec2 a) { return vec2(s) + a; }
inline vec2 operator-(float s, vec2 a) { return vec2(s) - a; }
inline vec2 operator*(float s, vec2 a) { return vec2(s * a.x, s * a.y); }
inline vec2 operator/(float s, vec2 a) { return vec2(s) / a; }
inline vec2 operator-(vec2 a) { return vec2(-a.x, -a.y); }
inline vec4 operator+(vec4 a, vec4 b) { return vec4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
inline vec4 operator-(vec4 a, vec4 b) { return vec4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w); }
inline vec4 operator*(vec4 a, vec4 b) { return vec4(a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w); }
inline vec4 operator/(vec4 a, vec4 b) { return vec4(a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w); }
inline vec4 operator+(vec4 a, float s) { return a + vec4(s); }
inline vec4 operator-(vec4 a, float s) { return a - vec4(s); }
inline vec4 operator*(vec4 a, float s) { return a * vec4(s); }
inline vec4 operator/(vec4 a, float s) { return a / vec4(s); }
inline vec4 operator+(float s, vec4 a) { return vec4(s) + a; }
inline vec4 operator-(float s, vec4 a) { return vec4(s) - a; }
inline vec4 operator*(float s, vec4 a) { return vec4(s) * a; }
inline vec4 operator/(float s, vec4 a) { return vec4(s) / a; }
inline vec4 operator-(vec4 a) { return vec4(-a.x, -a.y, -a.z, -a.w); }
inline vec2& operator+=(vec2& a, vec2 b) { return a = a + b; }
inline vec2& operator+=(vec2& a, float s) { return a = a + s; }
inline vec2& operator-=(vec2& a, vec2 b) { return a = a - b; }
inline vec2& operator-=(vec2& a, float s) { return a = a - s; }
inline vec2& operator*=(vec2& a, vec2 b) { return a = a * b; }
inline vec2& operator*=(vec2& a, float s) { return a = a * s; }
inline vec2& operator/=(vec2& a, vec2 b) { return a = a / b; }
inline vec2& operator/=(vec2& a, float s) { return a = a / s; }
inline vec3& operator+=(vec3& a, float s) { return a = a + s; }
inline vec3& operator-=(vec3& a, vec3 b) { return a = a - b; }
inline vec3& operator-=(vec3& a, float s) { return a = a - s; }
inline vec3& operator*=(vec3& a, vec3 b) { return a = a * b; }
inline vec3& operator*=(vec3& a, float s) { return a = a * s; }
inline vec3& operator/=(vec3& a, vec3 b) { return a = a / b; }
inline vec3& operator/=(vec3& a, float s) { return a = a / s; }
inline vec4& operator+=(vec4& a, vec4 b) { return a = a + b; }
inline vec4& operator+=(vec4& a, float s) { return a = a + s; }
inline vec4& operator-=(vec4& a, vec4 b) { return a = a - b; }
inline vec4& operator-=(vec4& a, float s) { return a = a - s; }
inline vec4& operator*=(vec4& a, vec4 b) { return a = a * b; }
inline vec4& operator*=(vec4& a, float s) { return a = a * s; }
inline vec4& operator/=(vec4& a, vec4 b) { return a = a / b; }
inline vec4& operator/=(vec4& a, float s) { return a = a / s; }

inline float min(float a, float b) { return std::min(a, b); }
inline vec3 min(vec3 a, vec3 b) { return vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)); }
inline int min(int a, int b) { return std::min(a, b); }
inline vec2 min(vec2 a, vec2 b) { return vec2(min(a.x, b.x), min(a.y, b.y)); }
inline vec2 min(vec2 a, float b) { return min(a, vec2(b)); }
inline vec3 min(vec3 a, float b) { return min(a, vec3(b)); }
inline vec4 min(vec4 a, vec4 b) { return vec4(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z), min(a.w, b.w)); }
inline vec4 min(vec4 a, float b) { return min(a, vec4(b)); }

inline float max(float a, float b) { return std::max(a, b); }
inline vec3 max(vec3 a, vec3 b) { return vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)); }
inline int max(int a, int b) { return std::max(a, b); }
inline vec2 max(vec2 a, vec2 b) { return vec2(max(a.x, b.x), max(a.y, b.y)); }
inline vec2 max(vec2 a, float b) { return max(a, vec2(b)); }
inline vec3 max(vec3 a, float b) { return max(a, vec3(b)); }
inline vec4 max(vec4 a, vec4 b) { return vec4(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z), max(a.w, b.w)); }
inline vec4 max(vec4 a, float b) { return max(a, vec4(b)); }

inline float clamp(float x, float low, float high) { return min(max(x, low), high); }
inline vec3 clamp(vec3 a, float l, float h) { return vec3(clamp(a.x, l, h), clamp(a.y, l, h), clamp(a.z, l, h)); }
inline vec2 clamp(vec2 a, float l, float h) { return vec2(clamp(a.x, l, h), clamp(a.y, l, h)); }
inline vec2 clamp(vec2 a, vec2 l, vec2 h) { return vec2(clamp(a.x, l.x, h.x), clamp(a.y, l.y, h.y)); }
inline vec3 clamp(vec3 a, vec3 l, vec3 h) { return vec3(clamp(a.x, l.x, h.x), clamp(a.y, l.y, h.y), clamp(a.z, l.z, h.z)); }
inline vec4 clamp(vec4 a, float l, float h) { return vec4(clamp(a.x, l, h), clamp(a.y, l, h), clamp(a.z, l, h), clamp(a.w, l, h)); }
inline vec4 clamp(vec4 a, vec4 l, vec4 h) { return vec4(clamp(a.x, l.x, h.x), clamp(a.y, l.y, h.y), clamp(a.z, l.z, h.z), clamp(a.w, l.w, h.w)); }

inline float mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }
inline vec3 mix(vec3 a, vec3 b, float t) { return a * (1.0f - t) + b * t; }
inline vec2 mix(vec2 a, vec2 b, float t) { return a * (1.0f - t) + b * t; }
inline vec2 mix(vec2 a, vec2 b, vec2 t) { return a * (1.0f - t) + b * t; }
inline vec3 mix(vec3 a, vec3 b, vec3 t) { return a * (1.0f - t) + b * t; }
inline vec4 mix(vec4 a, vec4 b, float t) { return a * (1.0f - t) + b * t; }
inline vec4 mix(vec4 a, vec4 b, vec4 t) { return a * (1.0f - t) + b * t; }

inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
inline vec2 step(vec2 edge, vec2 a) { return vec2(step(edge.x, a.x), step(edge.y, a.y)); }
inline vec2 step(float edge, vec2 a) { return step(vec2(edge), a); }
inline vec3 step(vec3 edge, vec3 a) { return vec3(step(edge.x, a.x), step(edge.y, a.y), step(edge.z, a.z)); }
inline vec3 step(float edge, vec3 a) { return step(vec3(edge), a); }
inline vec4 step(vec4 edge, vec4 a) { return vec4(step(edge.x, a.x), step(edge.y, a.y), step(edge.z, a.z), step(edge.w, a.w)); }
inline vec4 step(float edge, vec4 a) { return step(vec4(edge), a); }

inline float smoothstep(float edge0, float edge1, float x) {
    const float t = clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
inline vec2 smoothstep(vec2 e, vec2 f, vec2 a) { return vec2(smoothstep(e.x, f.x, a.x), smoothstep(e.y, f.y, a.y)); }
inline vec2 smoothstep(float e, float f, vec2 a) { return vec2(smoothstep(e, f, a.x), smoothstep(e, f, a.y)); }
inline vec3 smoothstep(vec3 e, vec3 f, vec3 a) { return vec3(smoothstep(e.x, f.x, a.x), smoothstep(e.y, f.y, a.y), smoothstep(e.z, f.z, a.z)); }
inline vec3 smoothstep(float e, float f, vec3 a) { return vec3(smoothstep(e, f, a.x), smoothstep(e, f, a.y), smoothstep(e, f, a.z)); }
inline vec4 smoothstep(vec4 e, vec4 f, vec4 a) { return vec4(smoothstep(e.x, f.x, a.x), smoothstep(e.y, f.y, a.y), smoothstep(e.z, f.z, a.z), smoothstep(e.w, f.w, a.w)); }
inline vec4 smoothstep(float e, float f, vec4 a) { return vec4(smoothstep(e, f, a.x), smoothstep(e, f, a.y), smoothstep(e, f, a.z), smoothstep(e, f, a.w)); }

inline float sign(float x) { return x > 0.0f ? 1.0f : (x < 0.0f ? -1.0f : 0.0f); }
inline vec2 sign(vec2 a) { return vec2(sign(a.x), sign(a.y)); }
inline vec3 sign(vec3 a) { return vec3(sign(a.x), sign(a.y), sign(a.z)); }
inline vec4 sign(vec4 a) { return vec4(sign(a.x), sign(a.y), sign(a.z), sign(a.w)); }

inline float abs(float x) { return std::fabs(x); }
inline vec3 abs(vec3 a) { return vec3(abs(a.x), abs(a.y), abs(a.z)); }
inline vec2 abs(vec2 a) { return vec2(abs(a.x), abs(a.y)); }
inline vec4 abs(vec4 a) { return vec4(abs(a.x), abs(a.y), abs(a.z), abs(a.w)); }

inline float floor(float x) { return std::floor(x); }
inline vec2 floor(vec2 a) { return vec2(floor(a.x), floor(a.y)); }
inline vec3 floor(vec3 a) { return vec3(floor(a.x), floor(a.y), floor(a.z)); }
inline vec4 floor(vec4 a) { return vec4(floor(a.x), floor(a.y), floor(a.z), floor(a.w)); }

inline float trunc(float x) { return std::trunc(x); }
inline vec2 trunc(vec2 a) { return vec2(trunc(a.x), trunc(a.y)); }
inline vec3 trunc(vec3 a) { return vec3(trunc(a.x), trunc(a.y), trunc(a.z)); }
inline vec4 trunc(vec4 a) { return vec4(trunc(a.x), trunc(a.y), trunc(a.z), trunc(a.w)); }

inline float ceil(float x) { return std::ceil(x); }
inline vec2 ceil(vec2 a) { return vec2(ceil(a.x), ceil(a.y)); }
inline vec3 ceil(vec3 a) { return vec3(ceil(a.x), ceil(a.y), ceil(a.z)); }
inline vec4 ceil(vec4 a) { return vec4(ceil(a.x), ceil(a.y), ceil(a.z), ceil(a.w)); }

inline float fract(float x) { return x - std::floor(x); }
inline vec2 fract(vec2 a) { return vec2(fract(a.x), fract(a.y)); }
inline vec3 fract(vec3 a) { return vec3(fract(a.x), fract(a.y), fract(a.z)); }
inline vec4 fract(vec4 a) { return vec4(fract(a.x), fract(a.y), fract(a.z), fract(a.w)); }

inline float mod(float x, float y) { return x - y * std::floor(x / y); }
inline vec2 mod(vec2 a, vec2 b) { return vec2(mod(a.x, b.x), mod(a.y, b.y)); }
inline vec2 mod(vec2 a, float b) { return mod(a, vec2(b)); }
inline vec3 mod(vec3 a, vec3 b) { return vec3(mod(a.x, b.x), mod(a.y, b.y), mod(a.z, b.z)); }
inline vec3 mod(vec3 a, float b) { return mod(a, vec3(b)); }
inline vec4 mod(vec4 a, vec4 b) { return vec4(mod(a.x, b.x), mod(a.y, b.y), mod(a.z, b.z), mod(a.w, b.w)); }
inline vec4 mod(vec4 a, float b) { return mod(a, vec4(b)); }

inline float sqrt(float x) { return std::sqrt(x); }
inline vec3 sqrt(vec3 a) { return vec3(sqrt(a.x), sqrt(a.y), sqrt(a.z)); }
inline vec2 sqrt(vec2 a) { return vec2(sqrt(a.x), sqrt(a.y)); }
inline vec4 sqrt(vec4 a) { return vec4(sqrt(a.x), sqrt(a.y), sqrt(a.z), sqrt(a.w)); }

inline float inversesqrt(float x) { return 1.0f / std::sqrt(x); }
inline vec2 inversesqrt(vec2 a) { return vec2(inversesqrt(a.x), inversesqrt(a.y)); }
inline vec3 inversesqrt(vec3 a) { return vec3(inversesqrt(a.x), inversesqrt(a.y), inversesqrt(a.z)); }
inline vec4 inversesqrt(vec4 a) { return vec4(inversesqrt(a.x), inversesqrt(a.y), inversesqrt(a.z), inversesqrt(a.w)); }

inline float exp2(float x) { return std::exp2(x); }
inline vec2 exp2(vec2 a) { return vec2(exp2(a.x), exp2(a.y)); }
inline vec3 exp2(vec3 a) { return vec3(exp2(a.x), exp2(a.y), exp2(a.z)); }
inline vec4 exp2(vec4 a) { return vec4(exp2(a.x), exp2(a.y), exp2(a.z), exp2(a.w)); }

inline float log2(float x) { return std::log2(x); }
inline vec2 log2(vec2 a) { return vec2(log2(a.x), log2(a.y)); }
inline vec3 log2(vec3 a) { return vec3(log2(a.x), log2(a.y), log2(a.z)); }
inline vec4 log2(vec4 a) { return vec4(log2(a.x), log2(a.y), log2(a.z), log2(a.w)); }

inline float exp(float x) { return std::exp(x); }
inline vec3 exp(vec3 a) { return vec3(exp(a.x), exp(a.y), exp(a.z)); }
inline vec2 exp(vec2 a) { return vec2(exp(a.x), exp(a.y)); }
inline vec4 exp(vec4 a) { return vec4(exp(a.x), exp(a.y), exp(a.z), exp(a.w)); }

inline float log(float x) { return std::log(x); }
inline vec2 log(vec2 a) { return vec2(log(a.x), log(a.y)); }
inline vec3 log(vec3 a) { return vec3(log(a.x), log(a.y), log(a.z)); }
inline vec4 log(vec4 a) { return vec4(log(a.x), log(a.y), log(a.z), log(a.w)); }

inline float pow(float x, float y) { return std::pow(x, y); }
inline vec3 pow(vec3 a, vec3 b) { return vec3(pow(a.x, b.x), pow(a.y, b.y), pow(a.z, b.z)); }
inline vec2 pow(vec2 a, vec2 b) { return vec2(pow(a.x, b.x), pow(a.y, b.y)); }
inline vec4 pow(vec4 a, vec4 b) { return vec4(pow(a.x, b.x), pow(a.y, b.y), pow(a.z, b.z), pow(a.w, b.w)); }

inline float radians(float degrees) { return 0.0174532925f * degrees; }
inline vec2 radians(vec2 a) { return vec2(radians(a.x), radians(a.y)); }
inline vec3 radians(vec3 a) { return vec3(radians(a.x), radians(a.y), radians(a.z)); }
inline vec4 radians(vec4 a) { return vec4(radians(a.x), radians(a.y), radians(a.z), radians(a.w)); }

inline float degrees(float radians) { return 57.2957795f * radians; }
inline vec2 degrees(vec2 a) { return vec2(degrees(a.x), degrees(a.y)); }
inline vec3 degrees(vec3 a) { return vec3(degrees(a.x), degrees(a.y), degrees(a.z)); }
inline vec4 degrees(vec4 a) { return vec4(degrees(a.x), degrees(a.y), degrees(a.z), degrees(a.w)); }

inline float sin(float x) { return std::sin(x); }
inline vec2 sin(vec2 a) { return vec2(sin(a.x), sin(a.y)); }
inline vec3 sin(vec3 a) { return vec3(sin(a.x), sin(a.y), sin(a.z)); }
inline vec4 sin(vec4 a) { return vec4(sin(a.x), sin(a.y), sin(a.z), sin(a.w)); }

inline float cos(float x) { return std::cos(x); }
inline vec2 cos(vec2 a) { return vec2(cos(a.x), cos(a.y)); }
inline vec3 cos(vec3 a) { return vec3(cos(a.x), cos(a.y), cos(a.z)); }
inline vec4 cos(vec4 a) { return vec4(cos(a.x), cos(a.y), cos(a.z), cos(a.w)); }

inline float tan(float x) { return std::tan(x); }
inline vec2 tan(vec2 a) { return vec2(tan(a.x), tan(a.y)); }
inline vec3 tan(vec3 a) { return vec3(tan(a.x), tan(a.y), tan(a.z)); }
inline vec4 tan(vec4 a) { return vec4(tan(a.x), tan(a.y), tan(a.z), tan(a.w)); }

inline float asin(float x) { return std::asin(clamp(x, -1.0f, 1.0f)); }
inline vec2 asin(vec2 a) { return vec2(asin(a.x), asin(a.y)); }
inline vec3 asin(vec3 a) { return vec3(asin(a.x), asin(a.y), asin(a.z)); }
inline vec4 asin(vec4 a) { return vec4(asin(a.x), asin(a.y), asin(a.z), asin(a.w)); }

inline float acos(float x) { return std::acos(clamp(x, -1.0f, 1.0f)); }
inline vec2 acos(vec2 a) { return vec2(acos(a.x), acos(a.y)); }
inline vec3 acos(vec3 a) { return vec3(acos(a.x), acos(a.y), acos(a.z)); }
inline vec4 acos(vec4 a) { return vec4(acos(a.x), acos(a.y), acos(a.z), acos(a.w)); }

inline float atan(float x) { return std::atan(x); }
inline float atan(float y, float x) { return std::atan2(y, x); }
inline vec2 atan(vec2 a) { return vec2(atan(a.x), atan(a.y)); }
inline vec2 atan(vec2 a, vec2 b) { return vec2(atan(a.x, b.x), atan(a.y, b.y)); }
inline vec3 atan(vec3 a) { return vec3(atan(a.x), atan(a.y), atan(a.z)); }
inline vec3 atan(vec3 a, vec3 b) { return vec3(atan(a.x, b.x), atan(a.y, b.y), atan(a.z, b.z)); }
inline vec4 atan(vec4 a) { return vec4(atan(a.x), atan(a.y), atan(a.z), atan(a.w)); }
inline vec4 atan(vec4 a, vec4 b) { return vec4(atan(a.x, b.x), atan(a.y, b.y), atan(a.z, b.z), atan(a.w, b.w)); }

inline float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
inline float dot(vec4 a, vec4 b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }

inline vec3 cross(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

inline float length(vec3 a) { return std::sqrt(dot(a, a)); }
inline float length(vec2 a) { return std::sqrt(dot(a, a)); }
inline float length(vec4 a) { return std::sqrt(dot(a, a)); }

inline float distance(vec3 a, vec3 b) { return length(a - b); }
inline float distance(vec2 a, vec2 b) { return length(a - b); }
inline float distance(vec4 a, vec4 b) { return length(a - b); }

inline vec3 normalize(vec3 a) { return a / std::sqrt(max(dot(a, a), 1.0e-36f)); }
inline vec2 normalize(vec2 a) { return a / std::sqrt(max(dot(a, a), 1.0e-36f)); }
inline vec4 normalize(vec4 a) { return a / std::sqrt(max(dot(a, a), 1.0e-36f)); }

inline vec3 reflect(vec3 incident, vec3 normal) { return incident - 2.0f * dot(normal, incident) * normal; }
inline vec2 reflect(vec2 i, vec2 n) { return i - 2.0f * dot(n, i) * n; }
inline vec4 reflect(vec4 i, vec4 n) { return i - 2.0f * dot(n, i) * n; }

inline vec3 refract(vec3 incident, vec3 normal, float eta) {
    const float cosine = dot(normal, incident);
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    return k < 0.0f ? vec3(0.0f) : eta * incident - (eta * cosine + std::sqrt(k)) * normal;
}

struct mat3 {  // three columns
    vec3 columns[3];
    mat3() = default;
    explicit mat3(float s) : columns{vec3(s, 0, 0), vec3(0, s, 0), vec3(0, 0, s)} {}
    mat3(vec3 a, vec3 b, vec3 c) : columns{a, b, c} {}
    vec3 operator[](int i) const { return columns[i]; }
};
inline mat3 operator+(const mat3& a, const mat3& b) { return mat3(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
inline mat3 operator-(const mat3& a, const mat3& b) { return mat3(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
inline mat3 operator*(const mat3& m, float s) { return mat3(m[0] * s, m[1] * s, m[2] * s); }
inline mat3 operator*(float s, const mat3& m) { return m * s; }
inline vec3 operator*(const mat3& m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
inline vec3 operator*(vec3 v, const mat3& m) { return vec3(dot(v, m[0]), dot(v, m[1]), dot(v, m[2])); }
inline mat3 operator*(const mat3& a, const mat3& b) { return mat3(a * b[0], a * b[1], a * b[2]); }

inline mat3 transpose(const mat3& m) { return mat3(vec3(m[0].x, m[1].x, m[2].x), vec3(m[0].y, m[1].y, m[2].y), vec3(m[0].z, m[1].z, m[2].z)); }

inline float determinant(const mat3& m) { return dot(m[0], cross(m[1], m[2])); }

inline mat3 inverse(const mat3& m) { return (1.0f / determinant(m)) * transpose(mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]))); }
