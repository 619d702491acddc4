// Who does the tasks of a job: this machine, a queue, or whoever is given the command lines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "submission.h"

/// Runs the open tasks, `processes` at a time, then the last one if all went well. What fails is reported,
/// and the rest is done all the same. Returns the exit code.
int run_locally(const Submission& job, std::size_t processes);

/// Throws candela::Error (bad_request) where a log in the job's folder cannot be named in a script for Slurm.
void require_folder_for_slurm(const Submission& job);

/// The scripts for Slurm: an array job of the open tasks, and the last one.
std::string slurm_script_of_tasks(const Submission& job);
std::string slurm_script_of_last(const Submission& job);
/// How sbatch is told that the last task comes after the others.
Words after_tasks(const std::string& number);

/// Hands them to sbatch, which are in the job's folder. Returns the numbers of the jobs. Throws
/// candela::Error (failure).
std::vector<std::string> submit_to_slurm(const Submission& job);
