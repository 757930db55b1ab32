#include "worker/clean_environment.h"

#include <algorithm>

namespace lampblack
{

QProcessEnvironment cleanEnvironment(const QString& folder)
{
    static const QStringList kept = {QStringLiteral("HOME"), QStringLiteral("PATH"),
                                     QStringLiteral("USER"), QStringLiteral("LOGNAME"),
                                     QStringLiteral("LANG"), QStringLiteral("LANGUAGE")};
    static const QStringList keptPrefixes = {QStringLiteral("LC_"), QStringLiteral("XDG_"),
                                             QStringLiteral("LAMPBLACK_")};
    const QProcessEnvironment ours = QProcessEnvironment::systemEnvironment();
    QProcessEnvironment clean;
    const QStringList names = ours.keys();
    for (const QString& name : names)
    {
        const auto startsWith = [&name](const QString& prefix)
        {
            return name.startsWith(prefix);
        };
        if (kept.contains(name) || std::any_of(keptPrefixes.begin(), keptPrefixes.end(), startsWith))
        {
            clean.insert(name, ours.value(name));
        }
    }
    // Its socket, and other files that it leaves if it is killed, are removed with this folder.
    clean.insert(QStringLiteral("TMPDIR"), folder);
    clean.remove(QStringLiteral("XDG_RUNTIME_DIR"));
    return clean;
}

} // namespace lampblack
