// A uniform view of the plugins that work on batches: arrays of floats in, arrays of floats out.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inputs.h"
#include "subject.h"

import candela.api;

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

BatchSubject batch_subject(const Values& values);
/// For a reflection model, on a surface of one colour: k_color is not read.
BatchSubject subject_of_one_color(const Values& values, candela::Rgb color);
/// For a reflection model, with parameters that differ from point to point; their values outlive the subject.
BatchSubject subject_of_varying(const Values& values, std::vector<candela::VaryingParameter> varying);

/// The interface's name for an input of this call, "to_observer.x".
std::string name_of_input(const Call& call, std::size_t array);

/// The results of a call.
Arrays outputs_of(const Call& call, const Arrays& in, std::size_t shift = 0);
