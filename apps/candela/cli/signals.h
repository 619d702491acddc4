// Cleaning up when a signal ends the command.
#pragma once

/// From now on, SIGINT, SIGTERM, SIGHUP and SIGPIPE still end the process, but leave no unfinished file or
/// temporary folder behind. A file that grows beyond its limit (RLIMIT_FSIZE) is an error like a full disk.
/// Call it first in main().
void prepare_for_signals();
