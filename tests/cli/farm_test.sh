# farm: the job that is written, what is refused, and GNU parallel running it to the bytes of one render.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
command -v parallel >/dev/null || { echo "FAILED: parallel is not installed; install the package of that name"; exit 1; }
rm -rf "the job" other-farm two.exr* slices one.exr job.out
small_scene >scene.pbrt
quick=(--spp 64 --slices 4 --seed 5 --aov Albedo,Z --no-trial)

# ------------------------------------------------------------------------------------------------ what is written

expect 0 "$T" farm slurm scene.pbrt "${quick[@]}" --reproducible --threads 3 --memory 2 --error 0.01 --print \
  --engine-option=--partition=night -o "two words.exr"
for line in "#SBATCH --array=1-4" "#SBATCH --requeue" "#SBATCH --signal=B:TERM@120" "#SBATCH --mem=1908M" "#SBATCH --cpus-per-task=3" \
  "#SBATCH --partition=night" "#SBATCH --job-name=two_words-render" "folder='$PWD/two words-farm'" \
  '--slice "${slice}/4" --resume --checkpoint 60' '"${folder}/slices/slice-${slice}.exr"' "--seed 5" "--aov Albedo,Z" "--reproducible" \
  'merge "${folder}/slices" -o "${output}" --error 0.01' '--dependency="afterany:${render%%;*}"'; do
  says "$line" out.txt
done
[ ! -e "two words-farm" ] || fail "--print wrote a folder"

# The scripts are such that a shell reads them.
expect 0 "$T" farm slurm scene.pbrt "${quick[@]}" --folder "the job" -o two.exr
says "tyndall status" out.txt
for script in "the job"/{render.sbatch,merge.sbatch,submit.sh}; do sh -n "$script" || fail "$script is no script"; done

# What slices take is told from a trial; more of them than build in a tenth of their time are advised against.
expect 0 "$T" farm parallel scene.pbrt --spp 4096 --slices 2 --folder other-farm -o two.exr --progress none
says "goes into building" err.txt
expect 0 "$T" farm parallel scene.pbrt --spp 1000000 --slices 4 --time 0.001 --print -o two.exr --progress none
says "of which building is a tenth" err.txt

# ------------------------------------------------------------------------------------------------ what is refused

expect 2 "$T" farm slurm scene.pbrt --spp 64 --slices 5 -o two.exr --no-trial
says "is empty: slices begin at multiples of 16" err.txt
expect 2 "$T" farm slurm scene.pbrt "${quick[@]}" -o two.png
says "give a name that ends so" err.txt
expect 2 "$T" farm openjd scene.pbrt "${quick[@]}" -o two.exr --submit
says "openjd has no command that submits" err.txt
expect 2 "$T" farm openjd scene.pbrt "${quick[@]}" -o two.exr --engine-option=--x
expect 2 "$T" farm parallel scene.pbrt "${quick[@]}" -o two.exr --folder "{}"
expect 2 "$T" farm seti scene.pbrt "${quick[@]}" -o two.exr
expect 2 "$T" farm slurm scene.pbrt "${quick[@]}" --slice 1/4 -o two.exr

# --------------------------------------------------------------------------------------------------- it is run

expect 0 "$T" render "$PWD/scene.pbrt" --spp 64 --seed 5 --aov Albedo,Z --reproducible -o one.exr
rm -rf "the job"
expect 0 "$T" farm parallel scene.pbrt "${quick[@]}" --reproducible --folder "the job" -o two.exr --submit --engine-option=--jobs=2
cmp one.exr two.exr || fail "GNU parallel's slices do not add up to the picture"

# A file cut in half is rendered again, and nothing else.
truncate --size=2000 "the job/slices/slice-2.exr"
before=$(stat -c %Y.%i "the job/slices/slice-3.exr")
expect 7 "$T" merge "the job/slices" -o part.exr
rm -f two.exr
expect 0 sh "the job/run.sh"
cmp one.exr two.exr || fail "a slice that was damaged is not rendered again"
[ "$(stat -c %Y.%i "the job/slices/slice-3.exr")" = "$before" ] || fail "a slice that was there was rendered again"
finish
