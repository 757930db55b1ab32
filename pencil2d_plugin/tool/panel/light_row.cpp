#include "tool/panel/light_row.h"

#include "tool/canvas/lamp_menu.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QKeyEvent>

namespace lampblack
{

namespace
{
constexpr int DiscSide = 14;
constexpr int MaxName = 80; // the schema's
} // namespace

QToolButton* smallButton(const QString& name, const QString& text, const QString& hint, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setText(text);
    button->setToolTip(hint);
    button->setAccessibleName(hint);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

QString titleOf(const AreaLight& light, int number)
{
    if (!light.name.isEmpty())
        return light.name;
    return (light.kind == LightKind::Sun ? LightRow::tr("Sun %1") : LightRow::tr("Light %1")).arg(number);
}

LightRow::LightRow(int number, QWidget* parent) : QWidget(parent), mNumber(number), mEdit(new QLineEdit(this))
{
    const QString name = QStringLiteral("lampblack.panel.light.%1").arg(number);
    mName = smallButton(name, QString(), QString(), this);
    mName->setToolTip(tr("Choose this light. Double-click to name it."));
    mName->setCheckable(true);
    mName->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    mName->setIconSize(QSize(DiscSide, DiscSide));
    mName->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    mName->installEventFilter(this);
    mSolo = smallButton(name + QStringLiteral(".solo"), QStringLiteral("S"),
                        tr("Solo: only this light shines"), this);
    mSolo->setCheckable(true);
    mEye = smallButton(name + QStringLiteral(".on"), QString(), tr("Switch this light on or off"), this);
    mEye->setCheckable(true);
    mEdit->setObjectName(name + QStringLiteral(".name"));
    mEdit->setMaxLength(MaxName);
    mEdit->installEventFilter(this);
    mEdit->hide();
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(1);
    row->addWidget(mName, 1);
    row->addWidget(mEdit, 1);
    row->addWidget(mSolo);
    row->addWidget(mEye);
    connect(mName, &QToolButton::clicked, this, &LightRow::selected);
    connect(mSolo, &QToolButton::clicked, this, &LightRow::soloed);
    connect(mEye, &QToolButton::clicked, this, &LightRow::switched);
    connect(mEdit, &QLineEdit::editingFinished, this, [this] { endRename(true); });
}

void LightRow::setLight(const AreaLight& light, bool selected)
{
    const QString title = titleOf(light, mNumber);
    mName->setText(title);
    mName->setAccessibleName(title);
    mName->setChecked(selected);
    mSolo->setChecked(light.solo);
    mEye->setChecked(light.on);
    mEye->setText(light.on ? tr("on") : tr("off"));
    if (mEdit->isHidden())
        mEdit->setText(light.name);
    mEdit->setPlaceholderText(title);
    // Only if it changes, because Qt keeps the pixmap of every icon that it has painted.
    const QColor disc = light.on ? light.colour : palette().color(QPalette::Mid);
    if (disc == mDisc)
        return;
    mDisc = disc;
    mName->setIcon(colourIcon(disc, DiscSide, devicePixelRatioF()));
}

bool LightRow::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == mName && event->type() == QEvent::MouseButtonDblClick)
    {
        beginRename();
        return true;
    }
    if (watched == mEdit && event->type() == QEvent::KeyPress &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
    {
        endRename(false);
        return true;
    }
    return false;
}

void LightRow::beginRename()
{
    mName->hide();
    mEdit->show();
    mEdit->selectAll();
    mEdit->setFocus();
}

void LightRow::endRename(bool keep)
{
    if (mEdit->isHidden())
        return;
    mEdit->hide();
    mName->show();
    if (keep)
        Q_EMIT renamed(mEdit->text().trimmed());
}

} // namespace lampblack
