# Prints functions in unnamed namespaces that have the name of one in another source of their folder.
# Sources of a folder are compiled together. Compilers find two that give one name to two things, but
# not two functions of one name whose parameters differ.
FNR == 1 { is_unnamed = 0 }
/^namespace \{/ { is_unnamed = 1 }
/^\}  \/\/ namespace/ { is_unnamed = 0 }
!is_unnamed || !/^[A-Za-z][^(]*[^:A-Za-z_0-9][A-Za-z_0-9]+\(/ { next }
/^(using|static_assert|template|class|struct|enum) / || /^[^(]*(::[A-Za-z_0-9]+|requires ?)\(/ { next }
{
  folder = FILENAME
  sub(/\/[^\/]*$/, "", folder)
  name = $0
  sub(/\(.*/, "", name)
  sub(/.*[^A-Za-z_0-9]/, "", name)
  key = folder " " name
  if (!(key in first)) first[key] = FILENAME
  if (first[key] != FILENAME) print FILENAME ":" FNR ": " name "() is in " first[key] ", too"
}
