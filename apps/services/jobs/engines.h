// The engines that run the tasks of a job: this machine, a queue, or whatever runs printed command lines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jobs/submission.h"

/// Runs the open tasks, `processes` at a time, then the last one if all succeeded. Reports failures and
/// continues with the other tasks. Returns the exit code.
int run_locally(const Submission& job, std::size_t processes);

/// Throws candela::Error (bad_request) if a log in the job's folder cannot be named in a Slurm script.
void require_folder_for_slurm(const Submission& job);

/// The Slurm scripts: an array job of the open tasks, and the last task.
std::string slurm_script_of_tasks(const Submission& job);
std::string slurm_script_of_last(const Submission& job);
/// The sbatch options that run the last task after the others.
Words after_tasks(const std::string& number);

/// Submits the scripts in the job's folder with sbatch. Returns the numbers of the jobs. Throws
/// candela::Error (failure).
std::vector<std::string> submit_to_slurm(const Submission& job);
