# fish completion of stdc-slam, from its own --help.
function __stdc_slam_commands
  stdc-slam --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z0-9]\+\)  *\(.*\)/\1\t\2/p'
end
function __stdc_slam_options
  set -l words (commandline -opc)
  test (count $words) -ge 2; and stdc-slam $words[2] --help 2>/dev/null | string match -r -a -- '--[a-z0-9-]+' | sort -u
end
complete -c stdc-slam -n __fish_use_subcommand -f -a '(__stdc_slam_commands)'
complete -c stdc-slam -n 'not __fish_use_subcommand' -a '(__stdc_slam_options)'
