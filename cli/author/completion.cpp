// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/commands.h"
#include "cli/common/report.h"
#include "engine/base/error.h"

#include <memory>
#include <string>

namespace keyline::cli {

namespace {

// bash parts words at : and = too; the program is given them whole, and what stands before the part that bash
// replaces is taken off again.
constexpr const char* kBash = R"(_keyline() {
    local line=${COMP_LINE:0:COMP_POINT} part=${COMP_WORDS[COMP_CWORD]} words candidate before
    read -ra words <<<"$line"
    [[ $line == *[[:space:]] ]] && words+=("")
    [[ $part == [:=] ]] && part=
    before=${words[-1]%"$part"}
    COMPREPLY=()
    while IFS=$'\t' read -r candidate _; do
        if [[ $candidate == :files ]]; then
            compopt -o default 2>/dev/null
            continue
        fi
        [[ $candidate == *[=.:] ]] && compopt -o nospace 2>/dev/null
        COMPREPLY+=("${candidate#"$before"}")
    done < <(keyline complete "${words[@]:1}" 2>/dev/null)
}
complete -F _keyline keyline
)";

constexpr const char* kZsh = R"(#compdef keyline
_keyline() {
    local line
    local -a parts open closed
    for line in "${(@f)$(keyline complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}"; do
        parts=("${(@ps:\t:)line}")
        case $parts[1] in
            '') ;;
            :files) _files ;;
            *[=.:]) open+=("$parts[1]") ;;
            *) closed+=("$parts[1]") ;;
        esac
    done
    (( $#closed )) && compadd -- "${closed[@]}"
    (( $#open )) && compadd -S '' -- "${open[@]}"
}
compdef _keyline keyline
)";

constexpr const char* kFish = R"(function __keyline_complete
    set -l words (commandline -opc)
    set -l typed (commandline -ct)
    for line in (keyline complete $words[2..] "$typed" 2>/dev/null)
        if test "$line" = :files
            __fish_complete_path "$typed"
        else
            echo $line
        end
    end
end
complete -c keyline -f -a '(__keyline_complete)'
)";

std::string script_for(const std::string& shell) {
    if (shell == "bash") return kBash;
    if (shell == "zsh") return kZsh;
    if (shell == "fish") return kFish;
    fail(ErrorKind::kGraph, "there is no completion for " + in_quotes(shell),
         "possible: 'bash', 'zsh' and 'fish'");
}

}  // namespace

void add_completion(const Command& program) {
    const Command command = program.add(
        "completion", "Print what teaches a shell to complete: source <(keyline completion bash)");
    const auto shell = std::make_shared<std::string>();
    command.argument("SHELL", *shell, "The shell").of_words("bash|zsh|fish");
    command.runs([shell] { return print_result(script_for(*shell)), 0; });
}

}  // namespace keyline::cli
