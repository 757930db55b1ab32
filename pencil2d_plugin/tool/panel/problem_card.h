// What went wrong, what to do, and details worth copying.
#pragma once

#include "user_error.h"

#include <QFrame>
#include <QLabel>

namespace lampblack
{

/// Hidden until there is something to tell; the newest problem stands.
class ProblemCard : public QFrame
{
    Q_OBJECT

public:
    explicit ProblemCard(QWidget* parent = nullptr);

    void tell(const UserError& error);
    const UserError& error() const { return mError; }
    /// What "Copy details" puts on the clipboard.
    QString report() const;

private:
    UserError mError;
    QLabel* mWhat;
    QLabel* mRemedy;
};

} // namespace lampblack
