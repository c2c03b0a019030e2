# Completion of recoil for bash, made by ./run docs.
_recoil() {
  local word=${COMP_WORDS[COMP_CWORD]} words=''
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W 'check simulate fit diagnose coverage init import bounce materials predict figure export compare report merge cluster pair plan help --help --version' -- "$word"))
    return
  fi
  case "${COMP_WORDS[1]} ${COMP_WORDS[COMP_CWORD-1]}" in
    help\ *) words='check simulate fit diagnose coverage init import bounce materials predict figure export compare report merge cluster pair plan help' ;;
    'fit --scheme') words='auto parametric residual wild case cluster' ;;
    'fit --solver') words='fast reference' ;;
    'init --provenance') words='measured digitised' ;;
    'import --format') words='webplotdigitizer heights intervals csv track recording rest tops blocks' ;;
    'import --sd-of') words='one mean' ;;
    'import --provenance') words='measured digitised synthetic' ;;
    'import --method') words='unknown velocimeter drop_heights bounce_intervals video' ;;
    'bounce --format') words='webplotdigitizer heights intervals csv track recording rest tops blocks' ;;
    'export --to') words='lammps liggghts yade openfoam fluent table' ;;
    'pair --positive') words='towards away' ;;
    'pair --provenance') words='measured digitised reconstruction synthetic' ;;
  esac
  if [ -z "$words" ] && [[ $word == -* ]]; then
    case ${COMP_WORDS[1]} in
      check) words='--help' ;;
      simulate) words='--help --velocity --diameter --history --dataset --parameters --json' ;;
      fit) words='--help --out --shard --replicates --scheme --seed --threads --solver --json --verbose' ;;
      diagnose) words='--help --causes --rates --out --shard --seed --threads --json --verbose' ;;
      coverage) words='--help --datasets --posterior --out --shard --replicates --seed --threads --json' ;;
      init) words='--help --points --provenance --diameter --sheet --map --particle --surface --like' ;;
      import) words='--help --format --into --sheet --map --sd-of --diameter --diameter-error --series --particle --surface --like --adhesion-energy --provenance --source --axis --reading-error --error-series --scatter --captured-below --drop-error --rebound-error --time-error --transpose --average --gravity --fps --scale --method --ambient-pressure --condition --decimal-comma --replace' ;;
      bounce) words='--help --diameter --format --ball --mass --out --sheet --map --series --captured-below --drop-error --rebound-error --time-error --transpose --average --gravity --fps --scale --ambient-pressure --condition --decimal-comma' ;;
      materials) words='--help --verbose' ;;
      predict) words='--help --sizes --unit --height --midpoints --dataset --out --replicates --seed --threads --json' ;;
      figure) words='--help --width --out --replicates --seed --threads' ;;
      export) words='--help --to --diameter --stock --velocity --dataset --parameters --out --replicates --seed --threads' ;;
      compare) words='--help --json' ;;
      report) words='--help --force --out --replicates --seed --threads' ;;
      merge) words='--help --missing --threads' ;;
      cluster) words='--help --shards --cpus --time --out' ;;
      pair) words='--help --like --unit --column --decimal-comma --positive --height --height-range --diameter-tolerance --velocity-tolerance --keep-later --threshold --angle --lost-share --per-bin --size-classes --size-edges --mean-diameter --into --provenance --impacts --histograms --out --replace --json' ;;
      plan) words='--help --diameter --error --impacts --events --checks --assume --scatter --floor --spread --velocity --parameters --out --replace --json --verbose' ;;
      help) words='--help' ;;
    esac
  fi
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}
complete -o filenames -F _recoil recoil
