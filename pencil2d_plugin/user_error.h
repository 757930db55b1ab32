// What a person is told when something goes wrong.
#pragma once

#include <QMetaType>
#include <QString>

namespace lampblack
{

/// What happened, what to do about it, and details worth copying into a report.
struct UserError
{
    enum class Kind
    {
        Other,
        NothingDrawn,    ///< over as soon as something is drawn
        NoWorker,        ///< the worker has been given up; it can be started again
        NoOtherComputer, ///< another computer was to work, and does not
        NotRead          ///< over as soon as the drawing can be read
    };
    QString what;
    QString remedy;
    QString details;
    Kind kind = Kind::Other;
    int frame = 0; ///< that it is about, if it is about one
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::UserError)
