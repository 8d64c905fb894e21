#pragma once

namespace stdc {

/// Threads of this process have stacks of 1 MB at least, whatever is asked for them: to be called before
/// those of CivetWeb are made. They get 100 kB there, less what libraries hold in thread-local storage, which
/// is 60 kB with OpenBLAS (glibc takes both from one piece: its bug 11787). What was left was too little for
/// its words about a broken connection, and the program crashed.
void have_large_thread_stacks();

}  // namespace stdc
