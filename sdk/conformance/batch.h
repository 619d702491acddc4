// A uniform view of the plugins that work on batches: arrays of floats in, arrays of floats out.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fence.h"
#include "subject.h"

import candela.api;
import candela.util;

/// Arrays of equal length, with room before and after each that nobody may write to. Reading there yields
/// NaN.
class Arrays {
  public:
    /// `shift`: the number of floats by which each array is misaligned.
    Arrays(std::size_t arrays, std::size_t count, std::size_t shift = 0);

    float* operator[](std::size_t array) {
        return fenced_.empty() ? data_[array].data() + k_guard + shift_ : fenced_[array]->as<float>();
    }
    const float* operator[](std::size_t array) const {
        return fenced_.empty() ? data_[array].data() + k_guard + shift_ : fenced_[array]->as<float>();
    }
    std::size_t arrays() const { return fenced_.empty() ? data_.size() : fenced_.size(); }
    std::size_t count() const { return count_; }

    candela::Vec3Span vec3(std::size_t first) {
        return {(*this)[first], (*this)[first + 1], (*this)[first + 2]};
    }
    candela::ConstVec3Span vec3(std::size_t first) const {
        return {(*this)[first], (*this)[first + 1], (*this)[first + 2]};
    }
    candela::Vec3 at(std::size_t first, std::size_t i) const { return vec3(first)[i]; }

    void fill(float value);
    /// A copy whose arrays end, or begin, at inaccessible memory, which the copy's own copies share. `name`
    /// names an array in messages about a call that trespasses (fence.h).
    Arrays fenced(Fence fence, const std::function<std::string(std::size_t array)>& name) const;
    /// Fills the arrays with canaries, which only writing removes; is_written() looks for them.
    void fill_with_canary();
    bool is_written(std::size_t array, std::size_t i) const { return !candela::is_canary((*this)[array][i]); }
    /// Elements [first, first + count) of all arrays.
    Arrays part(std::size_t first, std::size_t count, std::size_t shift = 0) const;
    /// "before" or "after" if the room there was written to, otherwise empty. For arrays without a fence.
    std::string trespass() const;
    friend bool operator==(const Arrays& a, const Arrays& b);

  private:
    static constexpr std::size_t k_guard = 64;
    std::size_t count_;
    std::size_t shift_;
    std::vector<std::vector<float>> data_;
    std::vector<std::shared_ptr<Fenced>> fenced_;  // used instead, if there are any
};

/// One way of calling an instance.
struct Call {
    std::string name;                  // "reflect"
    std::vector<std::string> outputs;  // the names of the results, each of three arrays
    bool adds = false;                 // to the contents of the outputs
    bool may_be_negative = false;
    std::function<void(std::size_t count, const Arrays& in, Arrays& out)> run;
};

/// A plugin's instance as calls on arrays.
struct BatchSubject {
    std::shared_ptr<candela::Instance> instance;
    std::size_t inputs = 0;
    std::vector<Call> calls;
};

/// The positions of the inputs among the arrays, for all kinds: three arrays each.
namespace inputs {
inline constexpr std::size_t k_normal = 0;    // N
inline constexpr std::size_t k_observer = 3;  // V
inline constexpr std::size_t k_tangent = 6;
inline constexpr std::size_t k_light = 9;     // L
inline constexpr std::size_t k_diffuse = 12;  // intensities
inline constexpr std::size_t k_specular = 15;
inline constexpr std::size_t k_position = 18;
inline constexpr std::size_t k_barycentric = 21;
inline constexpr std::size_t k_vertex_normal = 24;
inline constexpr std::size_t k_dpdu = 27;
inline constexpr std::size_t k_dpdv = 30;
inline constexpr std::size_t k_uv = 33;                // two
inline constexpr std::size_t k_corner_positions = 35;  // the triangle's: three vectors
inline constexpr std::size_t k_corner_normals = 44;    // also three vectors
inline constexpr std::size_t k_color = 53;             // C_o
inline constexpr std::size_t k_inputs = 56;
}  // namespace inputs

BatchSubject batch_subject(const Values& values);
/// For a reflection model, on a surface of one colour: k_color is not read.
BatchSubject subject_of_one_color(const Values& values, candela::Rgb color);

/// Lights as data, and an observer, around which inputs_for() places its points: a point light, an infinitely
/// distant one, and a spot light.
const candela::PunctualLighting& punctual_lighting();

/// Inputs as a renderer provides them, equal for equal `seed`: unit vectors, positions, colours.
Arrays inputs_for(std::size_t count, unsigned seed = 1);
/// Gives point `i` a triangle around its position, in the plane of its face normal, of about one metre.
void put_triangle(Arrays& in, std::size_t i, const std::array<candela::Vec3, 3>& normals);
/// Inputs whose vectors coincide, oppose each other or are orthogonal: V = N, L = V, a vertex normal that is
/// the face normal …
Arrays aligned_inputs();
/// The same inputs in a rotated world: all vectors and triangles are rotated, positions are not.
Arrays turned(const Arrays& in);
candela::Vec3 turned(candela::Vec3 v);

/// The interface's name for an input of this call, "to_observer.x".
std::string name_of_input(const Call& call, std::size_t array);

/// The results of a call.
Arrays outputs_of(const Call& call, const Arrays& in, std::size_t shift = 0);

/// "N = [0, 1, 0], …": an input, for messages.
std::string text_of_input(const Arrays& in, std::size_t i);
