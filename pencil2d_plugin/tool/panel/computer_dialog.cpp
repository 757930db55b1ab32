#include "tool/panel/computer_dialog.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

namespace lampblack
{

ComputerDialog::ComputerDialog(const Computer& computer, QWidget* parent)
    : QDialog(parent), mAddress(new QLineEdit(computer.address)),
      mButtons(new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel))
{
    setObjectName(QStringLiteral("lampblack.computer"));
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle(tr("Render on Another Computer"));
    auto* help =
        new QLabel(tr("A stronger computer of your studio can compute the light. The person who runs it "
                      "gives you its address and its key, and needs your public key."));
    help->setWordWrap(true);
    auto* form = new QFormLayout;
    mAddress->setObjectName(QStringLiteral("lampblack.computer.address"));
    mAddress->setPlaceholderText(QStringLiteral("10.0.0.5:7100"));
    connect(mAddress, &QLineEdit::textChanged, this, &ComputerDialog::update);
    form->addRow(tr("Its address"), mAddress);
    mKey = addKey(form, QStringLiteral("key"), tr("Its key"), computer.key, tr("Keys (*.key)"));
    mOwnKey = addKey(form, QStringLiteral("own_key"), tr("Your secret key"), computer.ownKey,
                     tr("Secret keys (*.key_secret)"));
    connect(mButtons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(mButtons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->addWidget(help);
    column->addLayout(form);
    column->addWidget(mButtons);
    update();
}

QLineEdit* ComputerDialog::addKey(QFormLayout* form, const QString& name, const QString& text,
                                  const QString& path, const QString& files)
{
    auto* edit = new QLineEdit(path);
    edit->setObjectName(QStringLiteral("lampblack.computer.") + name);
    edit->setMinimumWidth(fontMetrics().averageCharWidth() * 40);
    auto* choose = new QToolButton;
    choose->setText(tr("Choose…"));
    auto* row = new QHBoxLayout;
    row->addWidget(edit, 1);
    row->addWidget(choose);
    form->addRow(text, row);
    connect(edit, &QLineEdit::textChanged, this, &ComputerDialog::update);
    connect(choose, &QToolButton::clicked, this,
            [this, edit, text, files]
            {
                const QString chosen = QFileDialog::getOpenFileName(this, text, edit->text(), files);
                if (!chosen.isEmpty())
                    edit->setText(chosen);
            });
    return edit;
}

Computer ComputerDialog::computer() const
{
    return {mAddress->text().trimmed(), mKey->text().trimmed(), mOwnKey->text().trimmed()};
}

void ComputerDialog::update()
{
    const Computer said = computer();
    mButtons->button(QDialogButtonBox::Ok)
        ->setEnabled(!said.address.isEmpty() && !said.key.isEmpty() && !said.ownKey.isEmpty());
}

} // namespace lampblack
