// Asks how to reach the computer that is to compute the light.
#pragma once

#include "worker/worker.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>

namespace lampblack
{

/// Deletes itself when it is closed.
class ComputerDialog : public QDialog
{
    Q_OBJECT

public:
    ComputerDialog(const Computer& computer, QWidget* parent);

    Computer computer() const;

private:
    QLineEdit* addKey(QFormLayout* form, const QString& name, const QString& text, const QString& path,
                      const QString& files);
    void update();

    QLineEdit* mAddress;
    QLineEdit* mKey;
    QLineEdit* mOwnKey;
    QDialogButtonBox* mButtons;
};

} // namespace lampblack
