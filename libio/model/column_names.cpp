#include "libio/model/column_names.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <utility>

#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

using Names = std::map<std::string, std::vector<ColumnName>, std::less<>>;

/// A column, and its names as plain_name has them.
struct Words {
  std::string_view column;
  std::initializer_list<std::string_view> words;
};

// English, then German, French, Portuguese, Italian and Spanish. "mass" and "weight" are no names
// of an added mass: some tables say with them what a segment weighs itself.
constexpr std::string_view length_names[] = {
    "l",     "len",    "lg",       "seglength",   "segmentlength", "elementlength", "axiallength",
    "lange", "laenge", "longueur", "comprimento", "lunghezza",     "longitud"};
constexpr std::string_view outer_names[] = {"od",
                                            "outer",
                                            "outerdia",
                                            "odia",
                                            "outerdiam",
                                            "outerdiameter",
                                            "outsidedia",
                                            "outsidediameter",
                                            "outerd",
                                            "dout",
                                            "douter",
                                            "da",
                                            "daussen",
                                            "aussen",
                                            "aussendurchmesser",
                                            "diamext",
                                            "dext",
                                            "diametreext",
                                            "diametreexterieur",
                                            "diametroext",
                                            "diamexterno",
                                            "diametroexterno",
                                            "diametroesterno",
                                            "diametroexterior"};
constexpr std::string_view inner_names[] = {"id",
                                            "inner",
                                            "innerdia",
                                            "idia",
                                            "innerdiam",
                                            "innerdiameter",
                                            "insidedia",
                                            "insidediameter",
                                            "innerd",
                                            "din",
                                            "dinner",
                                            "bore",
                                            "di",
                                            "dinnen",
                                            "innen",
                                            "innendurchmesser",
                                            "bohrung",
                                            "diamint",
                                            "dint",
                                            "diametreint",
                                            "diametreinterieur",
                                            "alesage",
                                            "diametroint",
                                            "diaminterno",
                                            "diametrointerno",
                                            "diametrointerior"};

const Words others[] = {
    {"material", {"mat", "matl", "werkstoff", "materiau", "materiale"}},
    {"layer", {"layerno", "schicht", "couche", "camada"}},
    {"rayleigh_mass", {"alpha"}},
    {"rayleigh_stiffness", {"beta"}},
    {"station", {"sta",       "stano",   "stationno", "stationnumber",
                 "station#",  "sta#",    "stn",       "no",
                 "nr",        "#",       "n",         "segment",
                 "segmentno", "section", "sectionno", "row",
                 "elem",      "elemno",  "element",   "elementno",
                 "elem#",     "node",    "nodeno",    "knoten",
                 "noeud",     "no.",     "estacao",   "elemento"}},
    {"position",
     {"z", "at", "pos", "axialposition", "location", "axiallocation", "distance", "lage",
      "abscisse", "posicao"}},
    {"added_mass",
     {"addedweight", "addedwt", "addwt", "addedwgt", "addwgt", "addedw", "extmass", "extweight",
      "externalmass", "externalweight", "diskmass", "discmass", "lumpedmass", "pointmass",
      "zusatzmasse", "masseajoutee", "massaadicional"}},
    {"polar_inertia",
     {"ip", "jp", "addedip", "addip", "extip", "ipadded", "polar", "polarmoment",
      "polarmomentofinertia", "polarmassmoment", "polarmassmomentofinertia",
      "polaresmassentragheitsmoment", "inertiepolaire", "inerciapolar", "inerziapolare"}},
    {"diametral_inertia",
     {"it", "jt", "jd", "addedit", "addit", "extit", "itadded", "transverse", "transverseinertia",
      "transversemoment", "transversemomentofinertia", "transversemassmoment", "diametralmoment",
      "diametralmomentofinertia", "aquatorialestragheitsmoment", "inertiediametrale",
      "inerciadiametral", "inerciatransversal"}},
    {"unbalance",
     {"unbal", "imbalance", "unbalancemoment", "residualunbalance", "unwucht", "balourd",
      "desbalanceamento", "squilibrio", "desbalance"}},
    {"unbalance_angle",
     {"unbalangle", "unbalancephase", "unbalphase", "imbalanceangle", "unwuchtwinkel"}},
    {"bearing",
     {"brg", "bearings", "bearingname", "lager", "palier", "mancal", "cuscinetto", "cojinete"}},
    {"seal", {"seals", "sealname", "dichtung", "selo", "tenuta", "sello"}},
    {"probe", {"probes", "probename", "sensor", "sensors", "messstelle", "capteur", "sonda"}},
    {"name",
     {"component", "part", "description", "label", "bezeichnung", "benennung", "designation",
      "descricao"}},
    {"deflection", {"bow"}},
    {"angle", {"phase"}},
    {"speed",
     {"rotorspeed", "shaftspeed", "spinspeed", "spin", "runningspeed", "operatingspeed",
      "rotationalspeed", "rotationspeed", "rotatingspeed", "drehzahl", "vitesse",
      "vitessederotation", "regime", "velocidade", "rotacao", "velocita", "velocidad"}},
    {"whirl",
     {"freq", "frequency", "whirlfreq", "whirlfrequency", "whirlspeed", "whirlingspeed",
      "whirlingfrequency", "excitation", "excfreq", "excitationfreq", "excitationfrequency",
      "precessionfrequency", "vibrationfrequency", "frequenz", "wirbelfrequenz", "frequence",
      "frequencia", "frequenza", "frecuencia"}}};

/// Names that say the unit of their numbers.
struct WordWithUnit {
  std::string_view word, column, unit;
};
constexpr WordWithUnit with_units[] = {
    {"rpm", "speed", "rpm"}, {"n", "speed", "rpm"}, {"hz", "whirl", "Hz"}, {"cpm", "whirl", "rpm"}};

/// Diameters of both ends, and of the left and the right one: "od", "odleft", "leftod", "odl".
template <std::size_t N>
void add_diameters(Names& names, const std::string& side, const std::string_view (&words)[N]) {
  for (const std::string_view word : words) {
    names[std::string(word)].push_back({side + "_diameter", ""});
    for (const std::string end : {"left", "right"}) {
      const ColumnName column{side + "_" + end, ""};
      names[std::string(word) + end].push_back(column);
      names[end + std::string(word)].push_back(column);
      names[std::string(word) + end[0]].push_back(column);
    }
  }
}

/// Coefficients: k11 is kxx; b is another letter for damping.
void add_coefficients(Names& names) {
  for (const std::string group : {"k", "c", "m", "kt", "ct", "b"}) {
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) {
        const ColumnName column{(group == "b" ? "c" : group) + "xy"[i] + "xy"[j], ""};
        names[group + "12"[i] + "12"[j]].push_back(column);
        if (group == "b") names[group + "xy"[i] + "xy"[j]].push_back(column);
      }
    }
  }
}

Names all_names() {
  Names names;
  for (const WordWithUnit& word : with_units) {
    names[std::string(word.word)].push_back({std::string(word.column), word.unit});
  }
  for (const std::string_view word : length_names)
    names[std::string(word)].push_back({"length", ""});
  add_diameters(names, "outer", outer_names);
  add_diameters(names, "inner", inner_names);
  add_coefficients(names);
  for (const auto& [column, words] : others) {
    for (const std::string_view word : words) {
      names[std::string(word)].push_back({std::string(column), ""});
    }
  }
  return names;
}

}  // namespace

const std::vector<ColumnName>& columns_called(std::string_view name) {
  static const Names names = all_names();
  static const std::vector<ColumnName> none;
  const auto found = names.find(plain_name(name));
  return found == names.end() ? none : found->second;
}

bool names_remarks(std::string_view name) {
  static constexpr std::string_view words[] = {
      "remark",      "remarks",     "comment",       "comments",    "note",        "notes",
      "bemerkung",   "bemerkungen", "kommentar",     "kommentare",  "remarque",    "remarques",
      "observacoes", "observacao",  "observaciones", "commentaire", "osservazioni"};
  return std::find(std::begin(words), std::end(words), plain_name(name)) != std::end(words);
}

}  // namespace whirl::inline io
