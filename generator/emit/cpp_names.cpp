// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as C++ identifiers.
#include "emit/print_header.hpp"
#include "text/alphabet.hpp"
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

namespace {

/// Macros of at most seven characters in the headers of C, of POSIX and of their relatives on Linux. '*' stands for
/// capitals.
// clang-format off
constexpr std::string_view short_macros[] = {
    "ADJ_TAI", "AF_*", "AI_ALL", "AI_IDN", "B0", "B110", "B115200", "B1200", "B134", "B150", "B1800", "B19200",
    "B200", "B230400", "B2400", "B300", "B38400", "B460800", "B4800", "B50", "B500000", "B57600", "B576000", "B600",
    "B75", "B921600", "B9600", "BRKINT", "BS0", "BS1", "BSDLY", "BUFSIZ", "CANBSIZ", "CBAUD", "CBAUDEX", "CBRK",
    "CDSUSP", "CEOF", "CEOL", "CEOT", "CERASE", "CFLUSH", "CIBAUD", "CINTR", "CKILL", "CLNEXT", "CLOCAL", "CMIN",
    "CMSPAR", "CQUIT", "CR0", "CR1", "CR2", "CR3", "CRDLY", "CREAD", "CRPRNT", "CRTSCTS", "CS5", "CS6", "CS7", "CS8",
    "CSIGNAL", "CSIZE", "CSTART", "CSTATUS", "CSTOP", "CSTOPB", "CSUSP", "CTIME", "CWERASE", "DBL_DIG", "DBL_MAX",
    "DBL_MIN", "DT_BLK", "DT_CHR", "DT_DIR", "DT_FIFO", "DT_LNK", "DT_REG", "DT_SOCK", "DT_WHT", "E2BIG", "EACCES",
    "EADV", "EAGAIN", "EBADE", "EBADF", "EBADFD", "EBADMSG", "EBADR", "EBADRQC", "EBADSLT", "EBFONT", "EBUSY",
    "ECHILD", "ECHO", "ECHOCTL", "ECHOE", "ECHOK", "ECHOKE", "ECHONL", "ECHOPRT", "ECHRNG", "ECOMM", "EDEADLK",
    "EDOM", "EDOTDOT", "EDQUOT", "EEXIST", "EFAULT", "EFBIG", "EFTYPE", "EIDRM", "EILSEQ", "EINTR", "EINVAL", "EIO",
    "EISCONN", "EISDIR", "EISNAM", "EL2HLT", "EL3HLT", "EL3RST", "ELIBACC", "ELIBBAD", "ELIBMAX", "ELIBSCN", "ELNRNG",
    "ELOOP", "EMFILE", "EMLINK", "ENAVAIL", "ENFILE", "ENOANO", "ENOBUFS", "ENOCSI", "ENODATA", "ENODEV", "ENOENT",
    "ENOEXEC", "ENOKEY", "ENOLCK", "ENOLINK", "ENOMEM", "ENOMSG", "ENONET", "ENOPKG", "ENOSPC", "ENOSR", "ENOSTR",
    "ENOSYS", "ENOTBLK", "ENOTDIR", "ENOTNAM", "ENOTSUP", "ENOTTY", "ENXIO", "EOF", "EPERM", "EPIPE", "EPROTO",
    "ERANGE", "EREMCHG", "EREMOTE", "ERFKILL", "EROFS", "ESPIPE", "ESRCH", "ESRMNT", "ESTALE", "ETIME", "ETXTBSY",
    "EUCLEAN", "EUNATCH", "EUSERS", "EXDEV", "EXFULL", "EXTA", "EXTB", "EXTPROC", "FAPPEND", "FASYNC", "FF0", "FF1",
    "FFDLY", "FFSYNC", "FIOCLEX", "FIONBIO", "FLT_DIG", "FLT_MAX", "FLT_MIN", "FLUSHO", "FNDELAY", "FP_NAN",
    "FP_ZERO", "F_DUPFD", "F_EXLCK", "F_GETFD", "F_GETFL", "F_GETLK", "F_LOCK", "F_OK", "F_RDLCK", "F_SETFD",
    "F_SETFL", "F_SETLK", "F_SHLCK", "F_TEST", "F_TLOCK", "F_ULOCK", "F_UNLCK", "F_WRLCK", "HUPCL", "HZ", "I",
    "ICANON", "ICRNL", "IEXTEN", "IGNBRK", "IGNCR", "IGNPAR", "IMAXBEL", "INLCR", "INPCK", "INT_MAX", "INT_MIN",
    "IOC_IN", "IOC_OUT", "IOV_MAX", "IP_MTU", "IP_TOS", "IP_TTL", "ISIG", "ISTRIP", "IUCLC", "IUTF8", "IXANY",
    "IXOFF", "IXON", "LC_*", "LOCK_EX", "LOCK_NB", "LOCK_RW", "LOCK_SH", "LOCK_UN", "LOG_ERR", "LOG_FTP", "LOG_LPR",
    "LOG_PID", "L_INCR", "L_SET", "L_XTND", "L_ctermid", "L_cuserid", "L_tmpnam", "MOD_TAI", "MSG_*", "MS_SYNC",
    "NAN", "NBBY", "NCARGS", "NCC", "NCCS", "NFDBITS", "NGREG", "NGROUPS", "NI_IDN", "NL0", "NL1", "NLDLY", "NL_NMAX",
    "NODEV", "NOFILE", "NOFLSH", "NOGROUP", "NO_DATA", "NSIG", "NULL", "NZERO", "N_6PACK", "N_AX25", "N_HCI",
    "N_HDLC", "N_IRDA", "N_MASC", "N_MOUSE", "N_PPP", "N_R3964", "N_SLIP", "N_STRIP", "N_TTY", "N_X25", "OCRNL",
    "OFDEL", "OFILL", "OLCUC", "ONLCR", "ONLRET", "ONOCR", "OPOST", "O_ASYNC", "O_CREAT", "O_DSYNC", "O_EXCL",
    "O_FSYNC", "O_PATH", "O_RDWR", "O_RSYNC", "O_SYNC", "O_TRUNC", "PARENB", "PARMRK", "PARODD", "PENDIN", "PF_*",
    "POLL*", "PRIX*", "P_tmpdir", "REG_*", "R_OK", "SHUT_RD", "SHUT_WR", "SIGABRT", "SIGALRM", "SIGBUS", "SIGCHLD",
    "SIGCLD",
    "SIGCONT", "SIGEMT", "SIGFPE", "SIGHUP", "SIGILL", "SIGINT", "SIGIO", "SIGIOT", "SIGKILL", "SIGLOST", "SIGPIPE",
    "SIGPOLL", "SIGPROF", "SIGPWR", "SIGQUIT", "SIGSEGV", "SIGSTOP", "SIGSYS", "SIGTERM", "SIGTRAP", "SIGTSTP",
    "SIGTTIN", "SIGTTOU", "SIGURG", "SIGUSR1", "SIGUSR2", "SIGXCPU", "SIGXFSZ", "SIG_DFL", "SIG_ERR", "SIG_IGN",
    "SI_USER", "SNAN", "SNANF", "SNANF32", "SNANF64", "SNANL", "SOL_*", "SO_MARK", "SO_TYPE", "STA_CLK", "STA_DEL",
    "STA_FLL", "STA_INS", "STA_PLL", "S_IEXEC", "S_IFBLK", "S_IFCHR", "S_IFDIR", "S_IFIFO", "S_IFLNK", "S_IFMT",
    "S_IFREG", "S_IREAD", "S_IRGRP", "S_IROTH", "S_IRUSR", "S_IRWXG", "S_IRWXO", "S_IRWXU", "S_ISGID", "S_ISUID",
    "S_ISVTX", "S_IWGRP", "S_IWOTH", "S_IWUSR", "S_IXGRP", "S_IXOTH", "S_IXUSR", "TAB0", "TAB1", "TAB2", "TAB3",
    "TABDLY", "TCFLSH", "TCGET*", "TCIOFF", "TCION", "TCOOFF", "TCOON", "TCSANOW", "TCSBRK", "TCSBRKP", "TCSET*",
    "TCXONC", "TIOC*", "TMP_MAX", "TOSTOP", "VEOF", "VEOL", "VEOL2", "VERASE", "VINTR", "VKILL", "VLNEXT", "VMIN",
    "VQUIT", "VSTART", "VSTOP", "VSUSP", "VSWTC", "VT0", "VT1", "VTDLY", "VTIME", "VWERASE", "WEOF", "WEXITED",
    "WNOHANG", "WNOWAIT", "W_OK", "XCASE", "XTABS", "X_OK", "d_fileno", "errno", "h_addr", "h_errno", "linux",
    "math_errhandling", "s6_addr", "s6_addr16", "s6_addr32", "sched_priority", "st_atime", "st_ctime", "st_mtime",
    "stderr", "stdin", "stdout", "unix",
};
// clang-format on

/// Followed by letters of any kind.
constexpr std::string_view prefixes[] = {"AF_", "EIGEN_", "LAGEN_", "PF_", "PRI",
                                         "SCN", "SYS_",   "sa_",    "si_", "sigev_"};

/// The constants of <math.h> in all their types: M_PIl, M_PIf128.
constexpr std::string_view constants[] = {"M_1_PI", "M_2_PI",    "M_2_SQRTPI", "M_E",  "M_LN10",
                                          "M_LN2",  "M_LOG10E",  "M_LOG2E",    "M_PI", "M_PI_2",
                                          "M_PI_4", "M_SQRT1_2", "M_SQRT2"};

bool is_capital(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool matches(std::string_view pattern, std::string_view name)
{
    if (!pattern.ends_with('*')) return pattern == name;
    pattern.remove_suffix(1);
    return name.starts_with(pattern) && std::ranges::all_of(name.substr(pattern.size()), is_capital);
}

/// The constant with the suffix of a type, or alone.
bool is_constant(std::string_view name)
{
    const auto suffix = [&](std::string_view constant) {
        const std::string_view rest = name.substr(constant.size());
        return rest.empty() || rest == "f" || rest == "l" ||
               (rest[0] == 'f' && rest[1] >= '1' && rest[1] <= '9' && rest.size() <= 4);
    };
    return std::ranges::any_of(
        constants, [&](std::string_view constant) { return name.starts_with(constant) && suffix(constant); });
}

bool is_macro_name(std::string_view name)
{
    constexpr std::size_t long_name = 8;
    if (name.size() >= long_name && std::ranges::all_of(name, is_capital)) return true;
    return is_constant(name) || std::ranges::any_of(short_macros, [&](auto macro) { return matches(macro, name); }) ||
           std::ranges::any_of(prefixes, [&](auto prefix) {
               const auto next = name.size() > prefix.size() ? name[prefix.size()] : '_';
               const bool single = prefix.ends_with('_') || (next >= 'a' && next <= 'z');
               return name.starts_with(prefix) && next != '_' && single;
           });
}

// Names of a model as identifiers of a programming language.

/// Letters of ASCII, digits and '_' are kept, Greek is spelled, everything else is uXXXX; "x[1]" becomes x_1; a leading
/// digit and an empty name gain an 'n' in front. Two underscores in a row are reserved in C++, so runs of them become
/// one.
std::string spell(std::string_view name)
{
    std::string result;
    for (std::size_t at = 0; at < name.size();) {
        const char c = name[at];
        const GreekLetter* greek = greek_letter_at(name, at);
        const CodePoint point = decode_utf8(name, at);
        std::string piece;
        if (c == '_' || is_digit(point.value) || (point.value < 0x80 && is_letter(point.value)))
            piece = c;
        else if (c == '[' || c == ',')
            piece = "_";
        else if (greek != nullptr && !greek->name.empty())
            piece = greek->name;
        else if (c != ']' && c != ' ')
            piece = fmt::format("u{:04X}", static_cast<std::uint32_t>(point.value));
        at += std::max<std::size_t>(point.length, 1);
        if (piece == "_" && !result.empty() && result.back() == '_') continue;
        result += piece;
    }
    if (result.empty() || (result[0] >= '0' && result[0] <= '9')) result.insert(0, "n");
    if (result[0] == '_') result.insert(0, "n"); // reserved at file scope, and _X everywhere
    return result;
}

/// ASCII letters, digits and '_': "x[1]" becomes x_1, Greek is transliterated, other letters become "uXXXX". A reserved
/// name gains a trailing '_'; distinct names stay distinct (a second clash gains another '_'), and one that needs no
/// change keeps its own.
std::vector<std::string> identifiers(const std::vector<std::string>& names,
                                     const std::function<bool(std::string_view)>& is_reserved)
{
    std::set<std::string> plain; // a name that needs no change is never taken by one that does
    for (const std::string& name : names)
        if (spell(name) == name && !is_reserved(name)) plain.insert(name);
    std::set<std::string> taken;
    std::vector<std::string> result;
    for (const std::string& name : names) {
        std::string spelled = spell(name);
        if (is_reserved(spelled)) spelled += '_';
        while (taken.contains(spelled) || (spelled != name && plain.contains(spelled)))
            spelled += spelled.back() == '_' ? "1_" : "_"; // never two underscores in a row
        taken.insert(spelled);
        result.push_back(std::move(spelled));
    }
    return result;
}

/// Keywords and alternative tokens of C++20.
constexpr std::string_view keywords[] = {
    "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq",
};

/// Functions and macros in small letters that <cmath>, <complex.h>, <cstdlib> and their like may put into the global
/// namespace.
// clang-format off
constexpr std::string_view library[] = {
    "DOMAIN", "SING", "PLOSS", "TLOSS", "assert", "major", "minor", "signgam", "complex", "imaginary", "abs", "acos",
    "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "copysign", "cos", "cosh", "div", "drem",
    "erf", "erfc", "exp", "exp10", "exp2", "expm1", "fabs", "fdim", "finite", "floor", "fma", "fmax", "fmin", "fmod",
    "frexp", "gamma", "hypot", "ilogb", "index", "isinf", "isnan", "j0", "j1", "jn", "labs", "ldexp", "lgamma",
    "llrint", "llround", "log", "log10", "log1p", "log2", "logb", "lrint", "lround", "modf", "nan", "nearbyint",
    "nextafter", "nexttoward", "pow", "pow10", "remainder", "remquo", "rint", "round", "scalb", "scalbln", "scalbn",
    "significand", "sin", "sincos", "sinh", "sqrt", "tan", "tanh", "tgamma", "time", "trunc", "y0", "y1", "yn",
};
// clang-format on

/// Types and namespaces that the header itself uses.
constexpr std::string_view own[] = {
    "S",     "Scalar", "State",    "Base",  "Fibre", "Momenta", "Parameters",
    "Eigen", "Status", "StatusOf", "lagen", "std",   "t",
};

bool is_reserved(std::string_view name)
{
    return std::ranges::count(keywords, name) + std::ranges::count(library, name) + std::ranges::count(own, name) > 0 ||
           is_macro_name(name);
}

} // namespace

std::vector<std::string> cpp_names(const std::vector<std::string>& names)
{
    return identifiers(names, is_reserved);
}

} // namespace lagen
