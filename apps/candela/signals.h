// What happens when the system or a person ends the command.
#pragma once

/// From here on, SIGINT, SIGTERM and SIGHUP end the process as ever, but leave no unfinished file and no
/// temporary folder behind; a file that grows beyond its limit (RLIMIT_FSIZE) is an error like a full disk.
/// To be called first in main(), and again when something else has had these signals for a while.
void prepare_for_signals();
